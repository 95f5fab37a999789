/** Whether a robot stands still. */
import type { Drive } from './open-drive.ts';

/**
 * A robot that is slower stands still: m/s and rad/s. Chosen: above the noise of wheels and gyroscopes at rest;
 * standing.test.ts holds it.
 */
const STANDS = { linear: 0.02, angular: 0.05 };

/** By what its wheels are told, and by what its base measures, if it does. */
export function stands({
  station,
  odometry,
}: {
  station: { readonly motion: Pick<Drive['station']['motion'], 'decision' | 'ramping'> };
  odometry: Pick<Drive['odometry'], 'newest'>;
}): boolean {
  const { motion } = station;
  const { phase } = motion.decision;
  if (motion.ramping || (phase !== 'standing' && phase !== 'latched' && phase !== 'held')) return false;
  const twist = odometry.newest?.twist ?? null;
  if (twist === null) return true;
  const speed = Math.hypot(twist.linear.x, twist.linear.y, twist.linear.z);
  return speed <= STANDS.linear && Math.abs(twist.angular.z) <= STANDS.angular;
}
