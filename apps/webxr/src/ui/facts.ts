/** The table of figures over the picture: rows are made once, texts change. */
import type { Tone } from '../status/words.ts';
import { elements } from './elements.ts';

export interface Fact {
  name: string;
  value: string;
  tone?: Tone;
}

const rows = new Map<string, { term: HTMLElement; value: HTMLElement }>();

export function showFacts(facts: readonly Fact[]): void {
  const present = new Set<string>();
  for (const { name, value, tone } of facts) {
    present.add(name);
    let row = rows.get(name);
    if (row === undefined) {
      row = { term: document.createElement('dt'), value: document.createElement('dd') };
      row.term.textContent = name;
      elements.facts.append(row.term, row.value);
      rows.set(name, row);
    }
    if (row.value.textContent !== value) row.value.textContent = value;
    row.value.dataset['tone'] = tone ?? '';
  }
  for (const [name, row] of rows) {
    if (present.has(name)) continue;
    row.term.remove();
    row.value.remove();
    rows.delete(name);
  }
}
