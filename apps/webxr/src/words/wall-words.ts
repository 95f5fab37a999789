/** What the page with several robots says of each, and of all. */
import type { CellStop } from '../ground/wall/stop-all.ts';
import type { CellState } from '../ground/wall/wall-messages.ts';
import { texts } from './language.ts';
import type { Words } from './words.ts';

/** The heading above a page. */
export function cellName(cell: CellState | null, number: number): string {
  return cell?.name ?? cell?.robot ?? texts().wall.page(number);
}

/** What the heading says besides the name. @param silent the page has said nothing for a while */
export function cellWords(cell: CellState | null, stop: CellStop, silent: boolean): Words {
  const said = texts().wall.cell;
  if (stop === 'unheard') return { text: said.unheard, tone: 'bad' };
  if (cell === null || silent) return { text: said.silent, tone: 'warning' };
  if (cell.robot === null) return { text: said.noRobot, tone: 'neutral' };
  if (stop === 'unconfirmed') return { text: said.unconfirmed, tone: 'bad' };
  if (stop === 'asked') return { text: said.asked, tone: 'warning' };
  if (!cell.live) return { text: said.away, tone: 'warning' };
  if (cell.stopped) return { text: said.stopped, tone: 'bad' };
  return cell.drives ? { text: said.drives, tone: 'good' } : { text: said.live, tone: 'neutral' };
}

/** What became of STOP on all pages; `null` if it was not pressed. */
export function stopAllWords(stops: readonly CellStop[]): Words | null {
  const said = texts().wall.stop;
  const count = (stop: CellStop) => stops.filter((each) => each === stop).length;
  const asked = stops.length - count('none');
  if (asked === 0) return null;
  const [stopped, unheard, unconfirmed] = [count('stopped'), count('unheard'), count('unconfirmed')];
  if (unheard > 0) return { text: said.unheard(unheard, asked), tone: 'bad' };
  if (unconfirmed > 0) return { text: said.unconfirmed(unconfirmed), tone: 'bad' };
  return stopped === asked
    ? { text: said.stopped(stopped), tone: 'good' }
    : { text: said.asked, tone: 'warning' };
}
