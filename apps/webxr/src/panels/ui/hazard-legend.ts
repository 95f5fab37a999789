/** What the tints of hazards stand for. */
import { DROP_TINT, HIT_TINT, type Rgb } from '@farpoint/cloud-view';
import type { BodyHeights } from '@farpoint/operator';
import { hazardLegendWords } from '../../words/hazard-words.ts';
import { cssOf } from './legend.ts';

const TITLE = 'By height above the robot’s base alone. What stops the robot, its own obstacle guard decides';

/** @param heights `null`: the robot does not say which heights matter to it */
export function hazardLegend(heights: BodyHeights | null): HTMLElement {
  const words = hazardLegendWords(heights);
  const figure = document.createElement('figure');
  figure.className = 'legend overlay hazards';
  figure.title = TITLE;
  if (words.unknown === undefined) figure.append(swatch(HIT_TINT, words.hit), swatch(DROP_TINT, words.drop));
  else {
    const caption = document.createElement('figcaption');
    caption.textContent = words.unknown;
    figure.append(caption);
  }
  return figure;
}

function swatch(tint: Rgb, text: string): HTMLElement {
  const row = document.createElement('div');
  const colour = document.createElement('span');
  row.className = 'swatch';
  colour.style.background = cssOf(tint);
  row.append(colour, text);
  return row;
}
