/** The topics of the robot's ROS graph that bound its motion: laser scans, and what another program demands. */
import type { TopicTable } from '@farpoint/ros';
import { defineOption, type OptionValues, optionGroup, schema } from '@farpoint/service';
import * as z from 'zod';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type { GuardScan, GuardTopicsOptions } from '../../motion/obstacles/guard-topics-messages.ts';
import { mountSchema } from './guard.ts';
import { type RosKindValues, rosKindOf } from './sink.ts';

/** Laser scanners of a robot. Chosen: one at each corner. */
const MOST_SCANS = 4;

const topicSchema = z
  .string('must be text')
  .regex(/^\/[A-Za-z_][\w/]{0,199}$/, 'must be a topic’s full name, as in /scan');
const scanSchema: z.ZodType<GuardScan> = z.strictObject(
  { topic: topicSchema, mount: mountSchema },
  'must be a topic and its mount',
);

/** `/scan=x,y,z,roll,pitch,yaw /other=…`, or a list. */
const scansSchema = z.preprocess(
  (given) =>
    typeof given === 'string'
      ? given
          .split(/\s+/)
          .filter((part) => part !== '')
          .map((part) => {
            const at = part.indexOf('=');
            return at < 0 ? { topic: part } : { topic: part.slice(0, at), mount: part.slice(at + 1) };
          })
      : given,
  z
    .array(scanSchema, 'must be a list of topics with their mounts')
    .max(MOST_SCANS, `must be at most ${MOST_SCANS}`)
    .refine(
      (scans) => new Set(scans.map(({ topic }) => topic)).size === scans.length,
      'must name each topic once',
    ),
) as z.ZodType<GuardScan[]>;

export const guardTopicsOptions = optionGroup('guard', {
  guardScan: defineOption({
    schema: scansSchema,
    default: [],
    argument: 'SCANS',
    file: 'scans',
    help: 'topics of the robot’s ROS graph with sensor_msgs/LaserScan, and where each scanner’s frame sits in base_link: "/scan=x,y,z,roll,pitch,yaw /other=…"; in the file a list of { topic, mount }',
  }),
  guardScanFloor: defineOption({
    schema: schema.choice(['unseen', 'seen']),
    default: 'unseen',
    argument: 'CHOICE',
    file: 'scanFloor',
    help: 'whether floor over which only a laser scan passes counts as seen; seen: only where nothing is lower than the scan’s plane, and no floor is missing',
  }),
  guardCollisionTopic: defineOption({
    schema: schema.optional(topicSchema),
    default: null,
    argument: 'TOPIC',
    file: 'collision.topic',
    help: 'a topic of the robot’s ROS graph by which another program stops the robot or slows it down, for as long as it says so',
  }),
  guardCollisionType: defineOption({
    schema: schema.choice(['bool', 'speed']),
    default: 'bool',
    argument: 'TYPE',
    file: 'collision.type',
    help: 'bool: std_msgs/Bool, true stops; speed: std_msgs/Float32, the highest speed in m/s, 0 stops',
  }),
  guardCollisionSilent: defineOption({
    schema: schema.choice(['stop', 'slow']),
    default: 'stop',
    argument: 'CHOICE',
    file: 'collision.silent',
    help: 'what a silent collision topic means: stop, or slow: at most guard.unseenMps',
  }),
});

type GuardTopicsValues = RosKindValues &
  OptionValues<typeof guardTopicsOptions> & {
    stopSilenceMs: number;
    guardClearanceM: number;
    guardHeightM: number;
    guardUnseenMps: number;
    rosBaseFrame: string | null;
  };

/**
 * @param topics of the robot's graph @param graph the robot's graph of this kind
 * @returns `null` if no topic is configured
 */
export function toGuardTopics(
  values: GuardTopicsValues,
  topics: TopicTable,
  graph: (kind: GraphOptions['kind']) => GraphOptions,
  refuse: (key: 'guardScan' | 'guardCollisionTopic', detail: string) => void,
): GuardTopicsOptions | null {
  const { guardScan: scans, guardCollisionTopic: topic } = values;
  if (scans.length === 0 && topic === null) return null;
  const kind = rosKindOf(values);
  if (kind === null) {
    const key = scans.length > 0 ? 'guardScan' : 'guardCollisionTopic';
    refuse(key, 'needs a ROS graph: neither source nor sink is ROS');
    return null;
  }
  for (const scan of scans) {
    if (seesBand(scan, values)) continue;
    refuse('guardScan', `${scan.topic} sits outside guard.clearanceM to guard.heightM: it would see nothing`);
  }
  const silentMps = values.guardCollisionSilent === 'stop' ? 0 : values.guardUnseenMps;
  const collision =
    topic === null
      ? null
      : { topic, type: values.guardCollisionType, silentMs: values.stopSilenceMs, silentMps };
  const frames = {
    topics: topics.filter(({ as }) => as === 'tf' || as === 'pose'),
    base: values.rosBaseFrame,
  };
  return { graph: graph(kind), scans, collision, frames };
}

/** Whether a scanner can see anything at a height at which the robot would hit it. */
function seesBand(
  { mount: { z: height, roll, pitch } }: GuardScan,
  { guardClearanceM, guardHeightM }: GuardTopicsValues,
): boolean {
  const isLevel = Math.abs(Math.sin(roll)) < 0.01 && Math.abs(Math.sin(pitch)) < 0.01;
  return !isLevel || (height > guardClearanceM && height <= guardHeightM);
}
