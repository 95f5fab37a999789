/** Where the clouds come from. */
import { defineOption, optionGroup, schema } from '@farpoint/service';
import { DEFAULT_FOLDER, type TrustedOwner } from '@farpoint/shared-memory';
import * as z from 'zod';

const MESSAGE = 'must be a user’s numeric id, or any';
const trustedOwner: z.ZodType<TrustedOwner | null> = z.unknown().transform((value, context) => {
  if (value === null || value === 'any') return value;
  const id = typeof value === 'string' && /^\d{1,10}$/.test(value) ? Number(value) : value;
  if (typeof id === 'number' && Number.isInteger(id) && id >= 0 && id < 2 ** 32) return id;
  context.addIssue({ code: 'custom', message: MESSAGE });
  return z.NEVER;
});

/** Clouds from a producer in shared memory. */
export const shmOptions = optionGroup('source', {
  shmLayout: defineOption({
    schema: schema.choice(['farpoint', 'reference']),
    default: 'farpoint',
    argument: 'LAYOUT',
    help: 'shm: layout: farpoint (frames as the camera gives them), or reference (the reference system’s packed points)',
  }),
  shmFolder: defineOption({
    schema: schema.text(),
    default: DEFAULT_FOLDER,
    argument: 'FOLDER',
    help: 'folder of the shared-memory files, for both source and sink',
  }),
  shmOwner: defineOption({
    schema: trustedOwner,
    default: null,
    argument: 'USER',
    help: 'use shared-memory files of the user with this numeric id, too (`id -u NAME`), or of any user; default: only those of the robot’s own user and of root',
  }),
});

export const SOURCE_KINDS = ['sim', 'pcd', 'rgbd', 'shm', 'recording', 'ros1', 'ros2'] as const;

export const sourceOptions = optionGroup('source', {
  source: defineOption({
    schema: schema.choice(SOURCE_KINDS),
    default: 'sim',
    argument: 'KIND',
    file: 'kind',
    help: 'where the points come from: sim (a simulated robot), pcd (recorded clouds), rgbd (recorded colour and depth images), shm (a camera’s program, through shared memory), recording (an MCAP file or a ROS 1 bag), ros1 or ros2 (topics of a ROS graph)',
  }),
  fps: defineOption({
    schema: schema.optional(schema.number({ min: 0.1, max: 120 })),
    default: null,
    argument: 'RATE',
    help: 'maximum frames a second to request from the source; default: 60 for the simulated camera, a recording’s own rate, 30 for others',
  }),
  axes: defineOption({
    schema: schema.choice(['auto', 'optical', 'body']),
    default: 'auto',
    argument: 'AXES',
    help: 'ros1, ros2, recording, pcd: axes of the clouds’ frame: optical (z forward), body (x forward, z up), or auto: optical if the frame’s name says so, and for a pcd cloud on a grid',
  }),
  waitS: defineOption({
    schema: schema.optional(schema.number({ min: 0, max: 3600 })),
    default: null,
    argument: 'SECONDS',
    help: 'ros1, ros2, shm: how long to wait at startup for the first cloud or the producer; default: 30 for ROS, 10 for shm',
  }),
});
