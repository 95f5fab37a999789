import { Ros1Peers } from '../../packages/ros/src/testing/ros1-peers.ts';
import { aptInstall } from './apt-install.ts';

/** Installs a ROS 1 master and rospy, if possible. Without them, the tests that need them say so and are skipped. */
export async function ensureRos1(say: (line: string) => void): Promise<void> {
  if (Ros1Peers.find().python !== null) return;
  await aptInstall(Ros1Peers.PACKAGES, say);
  const { missing } = Ros1Peers.find();
  if (missing !== null) say(`the tests in a ROS 1 graph are skipped: ${missing}`);
}
