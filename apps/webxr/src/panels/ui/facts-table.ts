/**
 * The table of figures over the picture. Its rows are created once; only their texts change. On a small screen it is one line
 * until the operator opens it.
 */
import type { Fact } from '../../words/facts.ts';
import { figuresLine } from '../../words/figures-line.ts';
import { elements } from './elements.ts';

const rows = new Map<string, { term: HTMLElement; value: HTMLElement }>();
let shownNames = '';

elements.factsFold.addEventListener('click', () => {
  const open = elements.hud.dataset.facts !== 'open';
  elements.hud.dataset.facts = open ? 'open' : 'folded';
  elements.factsFold.ariaExpanded = String(open);
  // The space bar is the drive grip.
  elements.factsFold.blur();
});

export function showFacts(facts: readonly Fact[]): void {
  const line = figuresLine(facts);
  if (elements.factsFold.textContent !== line.text) elements.factsFold.textContent = line.text;
  elements.factsFold.dataset.tone = line.tone;
  for (const { name, value, tone } of facts) {
    let row = rows.get(name);
    if (row === undefined) {
      row = { term: document.createElement('dt'), value: document.createElement('dd') };
      row.term.textContent = name;
      rows.set(name, row);
    }
    if (row.value.textContent !== value) row.value.textContent = value;
    row.value.dataset.tone = tone ?? '';
  }
  const names = facts.map((fact) => fact.name).join('\n');
  if (names === shownNames) return;
  shownNames = names;
  elements.facts.replaceChildren(
    ...facts.flatMap(({ name }) => {
      const row = rows.get(name);
      return row === undefined ? [] : [row.term, row.value];
    }),
  );
}
