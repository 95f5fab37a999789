/** The menu's page with the robot's commands and its recording: what the page's panel has, row by row. Pure. */
import type { ShownCommand, ShownGroup, ShownRecording } from '../../state/commands-state.ts';
import { laterTexts, texts } from '../../words/language.ts';
import type { MenuItem } from './menu-item.ts';

export interface MenuCommands {
  readonly groups: readonly ShownGroup[];
  /** `null` if operators can do nothing about recordings, and nothing is recorded. */
  readonly recording: ShownRecording | null;
}

/**
 * Rows of entries on one page. Chosen: with the title and two entries that lead elsewhere they fit on the plate;
 * menu-commands.test.ts holds it.
 */
const ROWS = 13;

/** Each page of entries. A heading stands on the page of what it is about, and again where its group goes on. */
export function commandPages({ groups, recording }: MenuCommands): readonly (readonly MenuItem[])[] {
  const pages: MenuItem[][] = [[]];
  let rows = 0;
  const add = (heading: MenuItem | null, entries: readonly MenuItem[]) => {
    for (const [at, entry] of entries.entries()) {
      const needed = 2 + (at === 0 && heading !== null ? 1 : 0);
      const isFull = rows + needed > ROWS;
      if (isFull) {
        pages.push([]);
        rows = 0;
      }
      const page = pages.at(-1) as MenuItem[];
      if (heading !== null && (at === 0 || isFull)) {
        page.push(heading);
        rows++;
      }
      page.push(entry);
      rows += 2;
    }
  };
  if (recording !== null) {
    const { isOn, line, button, bookmark } = recording;
    const entries = [button, bookmark].flatMap((each) => (each === null ? [] : commandItem(each)));
    const heading: MenuItem = { text: line, choice: null, tone: isOn ? 'bad' : 'quiet' };
    if (entries.length === 0) {
      pages[0]?.push(heading);
      rows++;
    } else add(heading, entries);
  }
  for (const { name, commands } of groups) {
    const heading = name === '' ? texts().commands.otherGroup : name;
    const isOnly = name === '' && groups.length === 1;
    add(isOnly ? null : { text: heading, choice: null, tone: 'quiet' }, commands.map(commandItem));
  }
  return pages;
}

/** Two rows, whatever the robot says of it: what stands below stays where it is. What runs is cancelled by the same entry. */
function commandItem({ id, text, note, state, progress, cancel }: ShownCommand): MenuItem {
  const said = laterTexts().headsetMenu;
  const share = progress === null ? note : said.progress(Math.round(progress * 100), note);
  const item = { text: cancel ?? text, note: share };
  if (state === 'running') {
    if (cancel === null) return { ...item, choice: null, tone: 'chosen' };
    return {
      ...item,
      choice: { act: (actions) => actions.cancelCommand(id), closes: false },
      tone: 'chosen',
    };
  }
  const tone = state === 'armed' ? 'warning' : state === 'barred' ? 'quiet' : 'neutral';
  // What is barred can be pressed: the page says why it does nothing.
  return { ...item, choice: { act: (actions) => actions.pressCommand(id), closes: false }, tone };
}
