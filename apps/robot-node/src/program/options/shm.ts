/** Clouds from a producer in shared memory. */
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
