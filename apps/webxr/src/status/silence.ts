/**
 * How long nothing may come from the robot before the page says so. A robot that can be reached says something 20 times a
 * second.
 */

/** From now on no figure is live, ms. */
export const UNHEARD_MS = 400;
/** The connection counts as lost, and the banner says so, ms. The page looks four times a second. */
export const LOST_MS = 700;
/** The line about the link counts the seconds, ms. */
export const SILENT_MS = 1000;
