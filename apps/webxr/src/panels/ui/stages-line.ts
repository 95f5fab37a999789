/** A line over the picture: how late the clouds are, and the stage that takes longest. Opens the tile with all of them. */
import './stages-line.css';
import type { RobotClient } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { PageState } from '../../state/page-state.ts';
import { texts } from '../../words/language.ts';
import { stageLine } from '../../words/stage-words.ts';
import { elements } from './elements.ts';
import { quietButton } from './panel-parts.ts';

/** The figures are those of the last so many ms. Chosen: a change is seen while it is felt. */
const OVER_MS = 2000;

export function showStagesLine(client: RobotClient, state: PageState, open: () => void): void {
  const line = quietButton('', texts().timing.openStages, open);
  line.id = 'where-time';
  line.hidden = true;
  elements.facts.after(line);
  effect(() => {
    // They are told a few times a second.
    void state.figures.value;
    const window = client.statistics.frameStages()?.window;
    const text = window === undefined ? null : stageLine(window.summary(performance.now(), OVER_MS));
    line.hidden = text === null;
    if (text !== null && line.textContent !== text) line.textContent = text;
  });
}
