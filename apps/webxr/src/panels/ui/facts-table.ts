/** The table of figures over the picture. Its rows are created once; only their texts change. */
import type { Fact } from '../../words/facts.ts';
import { elements } from './elements.ts';

const rows = new Map<string, { term: HTMLElement; value: HTMLElement }>();
let shownNames = '';

export function showFacts(facts: readonly Fact[]): void {
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
