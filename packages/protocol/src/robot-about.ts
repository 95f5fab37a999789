/** What an operator must know of a robot before using it. */
import * as z from 'zod/mini';

/** Where what the robot shows comes from. */
export const shownSources = [
  'sensors', // its own: what is there now
  'simulation',
  'files', // a recording or pictures, played: nothing of it is there now
] as const;

/**
 * What an operator must know of the robot. Follows the welcome, and comes again at every change. Older robots do not send
 * it; older pages ignore it.
 */
export interface RobotAbout {
  type: 'about';
  /** Whether it has anything that velocities move. */
  drives: boolean;
  /** Where what it shows comes from. */
  shows: (typeof shownSources)[number];
  /** Whether the robot records the session now. */
  recorded: boolean;
}

export const robotAboutSchema = z.strictObject({
  type: z.literal('about'),
  drives: z.boolean(),
  shows: z.enum(shownSources),
  recorded: z.boolean(),
}) satisfies z.ZodMiniType<RobotAbout>;
