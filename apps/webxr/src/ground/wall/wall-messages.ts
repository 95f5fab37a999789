/** What the wall of pages and each page in it say to each other. */
import { displayNameSchema, robotIdSchema } from '@farpoint/protocol';
import * as z from 'zod/mini';

/** Press STOP. Presses are numbered, so that a page can say which it has heard. */
export const wallStopSchema = z.object({
  farpoint: z.literal('stop'),
  press: z.number().check(z.int(), z.positive()),
});

/** How a page is: sent when that changes, and twice a second. */
export const cellStateSchema = z.object({
  farpoint: z.literal('cell'),
  /** The chosen robot's id; `null`: none is chosen. */
  robot: z.nullable(robotIdSchema),
  name: z.nullable(displayNameSchema),
  /** Whether a session with it is established. */
  live: z.boolean(),
  /** Whether this operator holds a grip that drives it. */
  drives: z.boolean(),
  /** Whether its emergency stop is on, by what the robot said last. */
  stopped: z.boolean(),
  /** The newest press of the wall's STOP that the page has heard; 0: none. */
  heard: z.number().check(z.int(), z.nonnegative()),
});

export type WallStop = z.infer<typeof wallStopSchema>;
export type CellState = z.infer<typeof cellStateSchema>;
