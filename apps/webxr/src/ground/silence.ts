/**
 * How long nothing may come from the robot before the page says so. A robot that can be reached reports 20 times a second, and
 * the page looks at these times 40 times a second. Pure: time is an argument.
 */

/**
 * After this silence no figure of the robot counts as live, ms. Chosen: seven lost reports in a row, and the page has told by
 * half of a second; lost-link.page.ts holds it.
 */
const UNHEARD_MS = 400;
/**
 * After this silence the connection counts as lost for people, ms. Chosen: longer than most changes of a radio cell, and the
 * banner stands within a second; lost-link.page.ts holds it.
 */
const LOST_MS = 700;
/** Points count as missing after this many of their intervals: one may be lost, and the next is on its way. */
const POINT_INTERVALS = 1.5;

/** `unheard`: nothing has come for a moment. `lost`: for long enough that people must know what to do. */
export type Silence = 'heard' | 'unheard' | 'lost';

/** @param silentMs time since anything came from the robot */
export function silenceOf(silentMs: number): Silence {
  if (silentMs >= LOST_MS) return 'lost';
  return silentMs >= UNHEARD_MS ? 'unheard' : 'heard';
}

/**
 * Whether points come as they should: a page whose decoder hangs hears the robot and shows an old cloud.
 *
 * @param silentMs time since the last point @param framesPerSecond by the robot's telemetry
 */
export function arePointsHeard(silentMs: number, framesPerSecond: number): boolean {
  const usual = framesPerSecond > 0 ? (POINT_INTERVALS * 1000) / framesPerSecond : 0;
  return silentMs < Math.max(UNHEARD_MS, usual);
}
