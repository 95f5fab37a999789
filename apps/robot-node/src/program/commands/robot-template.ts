/** The configuration files that `init` writes: one for each kind of source. */
import { configTemplate } from '@farpoint/service';
import { playbackOptions } from '../options/playback.ts';
import { measurementOptions } from '../options/recording.ts';
import { robotProgram } from '../options/robot-program.ts';
import { rosOptions } from '../options/ros.ts';
import { shmOptions } from '../options/shm.ts';
import { simOptions } from '../options/sim.ts';
import type { SOURCE_KINDS } from '../options/source.ts';

export type SourceKind = (typeof SOURCE_KINDS)[number];

const HEAD = [
  'Configuration of a Farpoint robot.',
  '',
  'Each option is taken from the first that gives it: command line, environment, this file, default.',
  'Lines that begin with "#" and a key show options at their defaults. To change one, remove the "#".',
  'An unknown key or a value that is not allowed is an error. `farpoint-robot doctor` checks the whole robot.',
  'Give secrets (signaling.token, signaling.key) in the environment: FARPOINT_ROBOT_TOKEN, FARPOINT_ROBOT_KEY.',
];

/** Options that every robot decides, at their defaults. */
const ALWAYS = [
  'id',
  'name',
  'signaling',
  'source',
  'sink',
  'maxLinear',
  'maxAngular',
  'watchdogMs',
  'bitrateMbps',
] as const;

/** The names that drivers of cameras and bases commonly use. */
const ROS_TOPICS = [
  { topic: '/camera/depth_registered/points', as: 'cloud' },
  { topic: '/camera/depth_registered/camera_info', as: 'cameraInfo' },
  { topic: '/tf', as: 'tf' },
  { topic: '/tf_static', as: 'tf' },
  { topic: '/odom', as: 'pose' },
  { topic: '/cmd_vel', as: 'velocity' },
];

/** Values of a template that differ from the defaults. */
const SET: Record<SourceKind, Readonly<Record<string, unknown>>> = {
  sim: {},
  pcd: {},
  rgbd: {},
  recording: {},
  shm: { shmLayout: 'farpoint', sink: 'shm' },
  ros1: { sink: 'ros1', topics: ROS_TOPICS },
  ros2: { sink: 'ros2', topics: ROS_TOPICS },
};

/** Options that only some kinds of sources have. */
const ONLY: readonly { kinds: readonly SourceKind[]; options: object }[] = [
  { kinds: ['sim'], options: simOptions },
  { kinds: ['shm'], options: shmOptions },
  { kinds: ['pcd', 'rgbd', 'recording'], options: playbackOptions },
  { kinds: ['ros1', 'ros2'], options: rosOptions },
  { kinds: [], options: measurementOptions },
];

/** @param audit file of the audit log */
export function robotTemplate(source: SourceKind, audit?: string): string {
  const { options } = robotProgram;
  return configTemplate(robotProgram, {
    head: HEAD,
    values: {
      ...Object.fromEntries(ALWAYS.map((key) => [key, options[key].default])),
      source,
      ...SET[source],
      ...(audit === undefined ? {} : { auditLog: audit }),
    },
    leftOut: ONLY.filter(({ kinds }) => !kinds.includes(source)).flatMap(({ options: table }) =>
      Object.keys(table),
    ),
  });
}
