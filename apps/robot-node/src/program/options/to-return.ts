import { defaultReturnOptions } from '@farpoint/safety';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import type { ReturnConfiguration } from '../../motion/return/return-announcer.ts';
import type { RobotOptionKey, RobotOptionValues } from './robot-program.ts';
import { configuresOdometry, rosKindOf } from './sink.ts';

/**
 * The lease must be free by then, and its holder told, s. Chosen: the second that the lease's end is checked
 * and told within (docs/return.md).
 */
const AFTER_LEASE_S = 1;

/**
 * How the robot drives back by itself; undefined if it does not.
 *
 * @param refuse takes what is wrong
 * @param graph the robot's graph of this kind
 */
export function toReturn(
  values: RobotOptionValues,
  refuse: (key: RobotOptionKey, detail: string) => void,
  graph: (kind: GraphOptions['kind']) => GraphOptions,
): ReturnConfiguration | undefined {
  if (!values.return) return undefined;
  const {
    obstacleGuard,
    source,
    guardMount,
    leaseSilenceS,
    silenceS,
    returnAfterS,
    returnTopic: topic,
  } = values;
  if (obstacleGuard === 'off' || (source !== 'sim' && guardMount === null))
    refuse('return', 'needs the obstacle guard: guard.obstacles not off, and guard.mount');
  if (!configuresOdometry(values.source, values.topics))
    refuse(
      'return',
      'needs odometry: the source sim, or ros1 or ros2 with a topic of nav_msgs/Odometry with `as: pose`',
    );
  const leaseS = Math.min(leaseSilenceS, silenceS);
  if (returnAfterS < leaseS + AFTER_LEASE_S)
    refuse(
      'returnAfterS',
      `must be at least ${leaseS + AFTER_LEASE_S} s: a driver keeps the lease for ${leaseS} s`,
    );
  if (values.returnSpeed > values.maxLinear)
    refuse('returnSpeed', `must not be above the robot’s limit, ${values.maxLinear} m/s`);
  const kind = rosKindOf(values);
  if (topic !== null && kind === null)
    refuse('returnTopic', 'needs a ROS graph: neither source nor sink is ROS');
  return {
    options: {
      ...defaultReturnOptions,
      afterMs: returnAfterS * 1000,
      announceMs: values.returnAnnounceS * 1000,
      maxM: values.returnMaxM,
      maxLinear: values.returnSpeed,
      maxAngular: Math.min(defaultReturnOptions.maxAngular, values.maxAngular),
      unseen: values.returnUnseen,
    },
    topic: topic === null || kind === null ? null : { graph: graph(kind), topic },
  };
}
