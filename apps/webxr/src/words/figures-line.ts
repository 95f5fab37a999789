/** The table of figures in one line, where there is no room for all of them. */
import { type Fact, NO_FIGURE } from './facts.ts';
import { texts } from './language.ts';
import type { Words } from './words.ts';

/** What the robot does, how fast, how old the view is, and how many figures call for a look. */
export function figuresLine(facts: readonly Fact[]): Words {
  const { fold, names } = texts().figures;
  const figureOf = (wanted: string) => facts.find(({ name }) => name === wanted)?.value;
  // Without who did it, or where: the table says that.
  const state = figureOf(names.state)?.replace(/ \(.*\)$/, '') ?? fold;
  // Of the speed, the part ahead only.
  const speed = figureOf(names.speed)?.split('  ')[0] ?? NO_FIGURE;
  const tones = facts.map(({ tone }) => tone);
  const marked = tones.filter((tone) => tone === 'bad' || tone === 'warning').length;
  const text = [
    state,
    speed,
    figureOf(names.viewAge) ?? NO_FIGURE,
    ...(marked === 0 ? [] : [`⚠ ${marked}`]),
  ].join(' · ');
  const worst = tones.includes('bad') ? 'bad' : marked > 0 ? 'warning' : 'neutral';
  return { text, tone: worst };
}
