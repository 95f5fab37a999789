/** What the robot says about its own bounds on motion, for people. */

import type { RobotClient } from '@farpoint/operator';
import type { MotionState, ReturnState, Telemetry, Twist } from '@farpoint/protocol';
import { texts } from './language.ts';
import { fixed } from './numbers.ts';
import type { Words } from './words.ts';

/** Why the robot is not where its driver has left it. */
export function returnWords({ phase, metres, end }: ReturnState): Words {
  const said = texts().motion;
  if (phase === 'announcing') return { text: said.aboutToReturn, tone: 'warning' };
  if (phase === 'returning') return { text: said.returning, tone: 'warning' };
  const way = metres < 0.05 ? said.stayed : said.cameBack(fixed(metres, 1));
  return { text: end === undefined ? way : `${way}: ${said.returnEnds[end]}`, tone: 'warning' };
}

/**
 * What the robot does or has done by itself; or else why it does less than it is told, the strictest reason; `null` if it does
 * what it is told.
 */
export function motionWords(motion: MotionState | undefined): Words | null {
  if (motion?.return !== undefined) return returnWords(motion.return);
  const reason = motion?.reasons[0];
  if (motion === undefined || reason === undefined) return null;
  const held = motion.factor === 0;
  const facts = { age: age(motion.viewAgeMs), most: fixed(motion.mostLinear, 2), held };
  return { text: texts().motion.reasons[reason](facts), tone: held ? 'bad' : 'warning' };
}

/** How fast the robot may go, where that is less than its own limit; `null` if it is not. */
export function speedLimitWords({ motion }: Telemetry, maxLinear: number): Words | null {
  if (motion === undefined || motion.mostLinear >= maxLinear) return null;
  return {
    text: `${fixed(motion.mostLinear, 2)} m/s: ${texts().motion.seenOld(age(motion.viewAgeMs))}`,
    tone: 'warning',
  };
}

/**
 * How fast the robot is, how fast it may go now, and why not faster.
 *
 * @param maxLinear the most that it ever drives, m/s @param asked what its driver asks for; `null` if nobody here drives
 */
export function speedWords(
  { twist, motion }: Pick<Telemetry, 'twist' | 'motion'>,
  maxLinear: number,
  asked: Readonly<Twist> | null,
): Words {
  const said = texts().motion;
  const { x, y } = twist.linear;
  const speed = `${fixed(Math.hypot(x, y), 2)} m/s`;
  const reason = motion?.reasons[0];
  const wish = asked === null ? 0 : Math.hypot(asked.linear.x, asked.linear.y);
  if (motion !== undefined && reason !== undefined && motion.factor < 1 && asked !== null) {
    const why = said.shortReasons[reason](age(motion.viewAgeMs));
    if (motion.factor === 0) return { text: said.speedWhy(speed, said.held, why), tone: 'bad' };
    const most = Math.min(motion.mostLinear, motion.factor * wish);
    // While it only turns, no speed is asked for.
    const bound = wish === 0 ? said.slower : said.atMost(fixed(most, 2));
    return { text: said.speedWhy(speed, bound, why), tone: 'warning' };
  }
  if (motion !== undefined && motion.mostLinear < maxLinear) {
    const why = said.seenOld(age(motion.viewAgeMs));
    return { text: said.speedWhy(speed, said.atMost(fixed(motion.mostLinear, 2)), why), tone: 'warning' };
  }
  return { text: said.speed(speed, said.atMost(fixed(maxLinear, 2))), tone: 'neutral' };
}

/** The robot says all the time that it does not look where it goes. */
export function obstacleGuardWords(guard: 'off' | 'blind'): Words {
  const { guardOff, guardBlind } = texts().motion;
  return guard === 'off' ? { text: guardOff, tone: 'warning' } : { text: guardBlind, tone: 'bad' };
}

function age(ms: number | undefined): string {
  if (ms === undefined) return texts().measures.someTime;
  return ms < 1000 ? `${ms} ms` : `${fixed(ms / 1000, 1)} s`;
}

/**
 * Age of what the operator sees, ms: as the robot judges it while commands come, with the way to the robot and back;
 * otherwise since the capture of the newest that is on the screen. `null` while nothing is seen.
 */
export function viewAgeMs({ link, seen }: Pick<RobotClient, 'link' | 'seen'>, nowMs: number): number | null {
  const judgedMs = link.session.telemetry?.motion?.viewAgeMs;
  if (judgedMs !== undefined) return judgedMs;
  return seen.stampUs === null ? null : link.session.ageMs(seen.stampUs, nowMs);
}
