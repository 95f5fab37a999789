/** What the wall of robots says. */
import type { CellStop } from '../wall/stop-all.ts';
import type { CellState } from '../wall/wall-messages.ts';
import type { Tone } from './words.ts';

export const wallWords = {
  link: 'Side by side',
  /** Above a page. */
  cell: (cell: CellState | null, number: number) => cell?.name ?? cell?.robot ?? `Page ${number}`,
  close: (name: string) => `Close ${name}`,
  keys: (name: string | null) =>
    name === null ? 'Keys go to no robot: click on one.' : `Keys and controllers go to ${name}.`,
} as const;

export interface CellWords {
  readonly text: string;
  readonly tone: Tone;
}

/** What a page's heading says besides its name. @param silent the page has said nothing for a while */
export function cellWords(cell: CellState | null, stop: CellStop, silent: boolean): CellWords {
  if (stop === 'unheard')
    return { text: 'This page did not hear STOP: use the robot’s own stop.', tone: 'bad' };
  if (cell === null || silent) return { text: 'This page does not answer.', tone: 'warning' };
  if (cell.robot === null) return { text: 'No robot is chosen.', tone: 'neutral' };
  if (stop === 'unconfirmed') return { text: 'STOP is not confirmed yet.', tone: 'bad' };
  if (stop === 'asked') return { text: 'STOP…', tone: 'warning' };
  if (!cell.live) return { text: 'Not connected.', tone: 'warning' };
  if (cell.stopped) return { text: 'Emergency stop is on.', tone: 'bad' };
  return cell.drives ? { text: 'You drive.', tone: 'good' } : { text: 'Live.', tone: 'neutral' };
}

/** What became of STOP at all of them; empty if it was not pressed. */
export function stopAllWords(stops: readonly CellStop[]): CellWords | null {
  const count = (stop: CellStop) => stops.filter((each) => each === stop).length;
  const asked = stops.filter((each) => each !== 'none').length;
  if (asked === 0) return null;
  const [stopped, unheard, unconfirmed] = [count('stopped'), count('unheard'), count('unconfirmed')];
  const robots = (n: number) => `${n} robot${n === 1 ? '' : 's'}`;
  if (unheard > 0) return { text: `STOP: ${unheard} of ${asked} pages did not hear it.`, tone: 'bad' };
  if (unconfirmed > 0) return { text: `STOP: not confirmed by ${robots(unconfirmed)}.`, tone: 'bad' };
  if (stopped === asked) return { text: `STOP: ${robots(stopped)} stopped.`, tone: 'good' };
  return { text: 'STOP…', tone: 'warning' };
}
