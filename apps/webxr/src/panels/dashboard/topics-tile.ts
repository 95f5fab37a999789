/** The tile with the readings of the robot's topics, as they were at the instant that is shown. */
import type { RobotSession } from '@farpoint/operator';
import { shownReading } from '../../words/shown-readings.ts';
import { part, setText, type Tile } from './tile.ts';

const UPDATE_MS = 250;

export function topicsTile(session: () => RobotSession): Tile {
  const element = part('topics');
  const nothing = part('nothing', 'p');
  nothing.textContent = 'The robot has named no topics to show.';
  const list = document.createElement('dl');
  element.append(nothing, list);
  return {
    element,
    everyMs: () => UPDATE_MS,
    update({ nowMs, moment: { instantMs } }) {
      const readings = session()
        .readings.list(nowMs, instantMs ?? Number.POSITIVE_INFINITY)
        .map(shownReading);
      nothing.hidden = readings.length > 0;
      while (list.children.length > 2 * readings.length) list.lastElementChild?.remove();
      while (list.children.length < 2 * readings.length)
        list.append(document.createElement('dt'), document.createElement('dd'));
      readings.forEach(({ label, topic, text, tone }, i) => {
        const [term, value] = [list.children[2 * i], list.children[2 * i + 1]] as [HTMLElement, HTMLElement];
        setText(term, label);
        term.title = topic;
        setText(value, text);
        value.dataset.tone = tone;
      });
    },
    dispose() {},
  };
}
