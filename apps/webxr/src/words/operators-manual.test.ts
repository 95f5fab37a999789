/** The operator's manual says what the page says: its keys and buttons are those of the beginning, its quotations in the catalogue. */
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { STANDARD_MAP } from '../take/drive/controller-map.ts';
import { DEFAULT_KEYS } from '../take/drive/key-map.ts';
import { leavesOf, said } from '../testing/catalogue-leaves.ts';
import { english } from './en/catalogue.ts';
import { laterEnglish } from './en/later-catalogue.ts';
import { helpGroups } from './help-rows.ts';

const manual = readFileSync(new URL('../../../../docs/operators-manual.md', import.meta.url), 'utf8');

/** The cells of a table's rows, without its head. @param head its first line */
function tableAfter(head: string): string[][] {
  const lines = manual.slice(manual.indexOf(`\n${head}\n`) + 1).split('\n');
  const end = lines.findIndex((line) => !line.startsWith('|'));
  return lines.slice(2, end).map((line) => line.slice(2, -2).split(' | '));
}

test('its keys and buttons are those that the page has at first, and none is left out', () => {
  const pad = { name: 'Gamepad', map: STANDARD_MAP, isStandard: true };
  const rows = helpGroups(DEFAULT_KEYS, [pad]).flatMap((group) => group.rows);
  const mapped = rows
    .filter(({ keys, controllers }) => keys.length > 0 || controllers.length > 0)
    .map(({ what, keys, controllers }) => [
      what,
      keys.join(', '),
      controllers.flatMap(({ parts }) => parts).join(', ') || '–',
    ]);
  const told = tableAfter('| what | keys | gamepad |');
  expect(told.toSorted()).toEqual(mapped.toSorted());
});

test('what it quotes where the robot does not move, the page says', () => {
  // What a text names is left empty.
  const texts = leavesOf({ ...english, ...laterEnglish }).map((leaf) => said(leaf, ''));
  const page = texts.join('\n');
  const quoted = tableAfter('| what the page says | why | what to do |').map(([first = '']) => first);
  expect(quoted.length).toBeGreaterThan(12);
  for (const each of quoted) expect(page).toContain(each.replace(/^\*(.*)\*$/, '$1'));
});
