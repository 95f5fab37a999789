/** What has become of the wall's STOP at each page. Pure. */
import type { CellState } from './wall-messages.ts';

/**
 * A page that has not said within this time that it has heard the press does not hear, ms. Chosen: a page's main thread is seldom
 * busy for so long, and people act on what is said then. stop-all.test.ts holds it.
 */
const HEARS_WITHIN_MS = 500;
/** A robot that has not confirmed within this time is named, ms. Chosen: several round trips. stop-all.test.ts holds it. */
const CONFIRMS_WITHIN_MS = 1000;

export type CellStop =
  | 'none' // nothing was pressed, or there is nothing to stop
  | 'asked' // it is under way
  | 'stopped' // the robot has confirmed it
  | 'unconfirmed' // the page has heard it; the robot has not confirmed it yet
  | 'unheard'; // the page has not heard it

export interface Press {
  /** 0 if STOP was never pressed. */
  readonly press: number;
  readonly atMs: number;
}

/** @param cell what the page said last; `null` if it has said nothing yet */
export function cellStop(cell: CellState | null, { press, atMs }: Press, nowMs: number): CellStop {
  if (press === 0) return 'none';
  const sinceMs = nowMs - atMs;
  if (cell === null || cell.heard < press) return sinceMs < HEARS_WITHIN_MS ? 'asked' : 'unheard';
  if (cell.robot === null) return 'none';
  if (cell.stopped) return 'stopped';
  return sinceMs < CONFIRMS_WITHIN_MS ? 'asked' : 'unconfirmed';
}
