/** The tile with what the robot's components report: counts by level, then each report, the most urgent first. */
import type { ReportedComponents, RobotSession } from '@farpoint/operator';
import { diagnosticLevels } from '@farpoint/protocol';
import { ageText } from './number-words.ts';
import { part, setText, type Tile } from './tile.ts';

const UPDATE_MS = 500;
/** After this long without a report of any component, all are stale, ms. */
const SILENT_MS = 10_000;
const MOST_SHOWN = 100;
const WORDS = { error: 'error', warn: 'warning', stale: 'stale', ok: 'OK' } as const;

export function diagnosticsTile(session: () => RobotSession): Tile {
  const element = part('diagnostics');
  const counts = part('counts', 'p');
  const list = document.createElement('ul');
  list.className = 'reports';
  element.append(counts, list);
  return {
    element,
    everyMs: () => UPDATE_MS,
    update({ moment: { robotNowMs } }) {
      const topics = session().components.list();
      const silentMs = robotNowMs - Math.max(...topics.map(({ timeMs }) => timeMs));
      const isSilent = silentMs > SILENT_MS;
      element.dataset.stale = String(topics.length === 0 || isSilent);
      setText(counts, countWords(topics, isSilent ? silentMs : null));
      const reports = topics.flatMap((topic) => topic.reports).slice(0, MOST_SHOWN);
      while (list.children.length > reports.length) list.lastElementChild?.remove();
      while (list.children.length < reports.length) list.append(row());
      reports.forEach(({ name, level, message, sinceMs }, i) => {
        const item = list.children[i] as HTMLElement;
        item.dataset.level = level;
        const [word, text, age] = [...item.children] as [HTMLElement, HTMLElement, HTMLElement];
        setText(word, WORDS[level]);
        setText(text, message === '' ? name : `${name}: ${message}`);
        setText(age, ageText(Math.max(0, robotNowMs - sinceMs)));
      });
    },
    dispose() {},
  };
}

function countWords(topics: readonly ReportedComponents[], silentMs: number | null): string {
  if (topics.length === 0) return 'No component has reported.';
  const words = diagnosticLevels.flatMap((level) => {
    const count = topics.reduce((sum, { counts }) => sum + counts[level], 0);
    return count === 0 ? [] : [`${count} ${WORDS[level]}`];
  });
  const ago = silentMs === null ? '' : ` (nothing for ${ageText(silentMs)})`;
  const recorded = topics.some((topic) => topic.recorded) ? ' (recorded)' : '';
  return `${words.join(', ')}${recorded}${ago}`;
}

function row(): HTMLElement {
  const item = document.createElement('li');
  item.append(part('level', 'span'), part('report', 'span'), part('age', 'span'));
  return item;
}
