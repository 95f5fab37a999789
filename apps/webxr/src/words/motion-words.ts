/** What the robot says about its own bounds on motion, for people. */

import type { RobotClient } from '@farpoint/operator';
import type { Intervention, MotionState, ReturnEnd, ReturnState, Telemetry, Twist } from '@farpoint/protocol';
import type { Words } from './words.ts';

const ends: Readonly<Record<ReturnEnd, string>> = {
  'service-back': 'until somebody was heard again',
  estop: 'until the emergency stop',
  'track-end': 'to the beginning of its track',
  moved: 'something else moved it',
  'no-track': 'it knew no way',
  'off-track': 'until it was off its track',
  'odometry-silent': 'until it did not know where it was',
  'sensor-silent': 'until a sensor gave nothing',
  unseen: 'until no sensor saw the way',
  blocked: 'until something was in the way',
  'no-wheels': 'until nothing took its velocities',
  'too-long': 'until its time was up',
};

/** Why the robot is not where its driver has left it. */
export function returnWords({ phase, metres, end }: ReturnState): Words {
  if (phase === 'announcing')
    return { text: 'The link was lost: the robot is about to drive back', tone: 'warning' };
  if (phase === 'returning')
    return { text: 'The link was lost: the robot drives back along its track', tone: 'warning' };
  const why = end === undefined ? '' : `: ${ends[end]}`;
  const way =
    metres < 0.05
      ? 'The link was lost; the robot stayed'
      : `The link was lost; it came back ${metres.toFixed(1)} m`;
  return { text: way + why, tone: 'warning' };
}

type Explain = (motion: MotionState) => string;

const explanations: Record<Intervention, Explain> = {
  'view-unknown': () => 'The robot waits until you see it',
  'view-late': ({ viewAgeMs }) => `Slower: what you see is ${age(viewAgeMs)} old`,
  'view-lost': () => 'Held: what you see is too old. Let go, then drive',
  'blind-travel': ({ mostLinear, viewAgeMs }) =>
    `At most ${mostLinear.toFixed(2)} m/s: what you see is ${age(viewAgeMs)} old`,
  'obstacle-near': () => 'Slower: something is near',
  obstacle: () => 'Held: something is in the way',
  'drop-off': () => 'Held: the floor ahead is missing',
  'unseen-space': () => 'Slower: no sensor sees where you are going',
  'sensor-silent': () => 'Slower: a sensor gives nothing',
  'collision-topic': ({ factor }) =>
    factor === 0
      ? 'Held: the robot’s collision sensor demands it'
      : 'Slower: the robot’s collision sensor demands it',
  'collision-silent': ({ factor }) =>
    `${factor === 0 ? 'Held' : 'Slower'}: the robot’s collision sensor says nothing`,
  'fence-near': () => 'Slower: near the edge of the permitted area',
  fence: () => 'Held: the edge of the permitted area',
};

/**
 * What the robot does or has done by itself; or else why it does less than it is told, the strictest reason; `null` if it does
 * what it is told.
 */
export function motionWords(motion: MotionState | undefined): Words | null {
  if (motion?.return !== undefined) return returnWords(motion.return);
  const reason = motion?.reasons[0];
  if (motion === undefined || reason === undefined) return null;
  return { text: explanations[reason](motion), tone: motion.factor === 0 ? 'bad' : 'warning' };
}

/** How fast the robot may go, where that is less than its own limit; `null` if it is not. */
export function speedLimitWords({ motion }: Telemetry, maxLinear: number): Words | null {
  if (motion === undefined || motion.mostLinear >= maxLinear) return null;
  return {
    text: `${motion.mostLinear.toFixed(2)} m/s: what you see is ${age(motion.viewAgeMs)} old`,
    tone: 'warning',
  };
}

/** In a few words: why it may go no faster now. */
const limitReasons: Record<Intervention, Explain> = {
  'view-unknown': () => 'it waits until you see it',
  'view-late': ({ viewAgeMs }) => `what you see is ${age(viewAgeMs)} old`,
  'view-lost': () => 'what you see is too old',
  'blind-travel': ({ viewAgeMs }) => `what you see is ${age(viewAgeMs)} old`,
  'obstacle-near': () => 'something is near',
  obstacle: () => 'something is in the way',
  'drop-off': () => 'the floor ahead is missing',
  'unseen-space': () => 'no sensor sees the way',
  'sensor-silent': () => 'a sensor gives nothing',
  'collision-topic': () => 'its collision sensor demands it',
  'collision-silent': () => 'its collision sensor says nothing',
  'fence-near': () => 'the edge of the permitted area is near',
  fence: () => 'the edge of the permitted area',
};

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
  const { x, y } = twist.linear;
  const speed = `${Math.hypot(x, y).toFixed(2)} m/s`;
  const reason = motion?.reasons[0];
  const wish = asked === null ? 0 : Math.hypot(asked.linear.x, asked.linear.y);
  if (motion !== undefined && reason !== undefined && motion.factor < 1 && asked !== null) {
    const why = limitReasons[reason](motion);
    if (motion.factor === 0) return { text: `${speed}, held: ${why}`, tone: 'bad' };
    const most = Math.min(motion.mostLinear, motion.factor * wish);
    // While it only turns, no speed is asked for.
    const bound = wish === 0 ? 'slower' : `at most ${most.toFixed(2)}`;
    return { text: `${speed}, ${bound}: ${why}`, tone: 'warning' };
  }
  if (motion !== undefined && motion.mostLinear < maxLinear) {
    const why = `what you see is ${age(motion.viewAgeMs)} old`;
    return { text: `${speed}, at most ${motion.mostLinear.toFixed(2)}: ${why}`, tone: 'warning' };
  }
  return { text: `${speed}, at most ${maxLinear.toFixed(2)}`, tone: 'neutral' };
}

/** The robot says all the time that it does not look where it goes. */
export const obstacleGuardWords: Readonly<Record<'off' | 'blind', Words>> = {
  off: { text: 'The robot does not brake for obstacles', tone: 'warning' },
  blind: { text: 'The robot cannot see obstacles now', tone: 'bad' },
};

function age(ms: number | undefined): string {
  if (ms === undefined) return 'some time';
  return ms < 1000 ? `${ms} ms` : `${(ms / 1000).toFixed(1)} s`;
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
