/** Where things stand is said in one style sheet; the panels' own name an area of it, and nothing more. */
import { globSync, readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));
const read = (path: string) => readFileSync(path, 'utf8').replaceAll(/\/\*.*?\*\//gs, '');

/** All but that of the page with several robots, which has frames and no panels. */
const SHEETS = globSync('**/*.css', { cwd: at('../..') })
  .filter((path) => basename(path) !== 'wall.css')
  .map((path) => ({ name: basename(path), css: read(at(`../../${path}`)) }));
const layout = SHEETS.find(({ name }) => name === 'layout.css')?.css ?? '';
const panelSheets = SHEETS.filter(({ name }) => name !== 'layout.css');

interface Rule {
  readonly selector: string;
  readonly body: string;
}

function rulesOf(css: string): Rule[] {
  return [...css.matchAll(/([^{};]+)\{([^{}]*)\}/g)].map(([, selector = '', body = '']) => ({
    selector: selector.trim(),
    body,
  }));
}

/** Names that both axes of a grid have, with where they begin and end. */
function areasOf(template: string): string[] {
  const [columns = '', rows = ''] = ['columns', 'rows'].map(
    (axis) => new RegExp(`grid-template-${axis}:([^;]*);`).exec(template)?.[1] ?? '',
  );
  const names = new Set([...columns.matchAll(/[\w-]+(?=-start)/g)].map(([name]) => name));
  const has = (axis: string, name: string) => axis.includes(`${name}-start`) && axis.includes(`${name}-end`);
  return [...names].filter((name) => has(columns, name) && has(rows, name)).sort();
}

/** The grid of each kind of screen. */
const grids = rulesOf(layout)
  .filter(({ selector, body }) => /(^|\s)body$/.test(selector) && body.includes('grid-template-columns'))
  .map(({ body }) => areasOf(body));
const areas = grids[0] ?? [];

/** What stands on the page itself: `id` of each, from the HTML. */
const html = readFileSync(at('../../../index.html'), 'utf8');
const standing = [...html.matchAll(/^ {4}<(?!dialog)\w+ id="([\w-]+)"/gm)].map(([, id = '']) => id);

test('every grid has the same areas, and the document lists them', () => {
  expect(grids.length).toBeGreaterThan(1);
  for (const grid of grids) expect(grid).toEqual(areas);
  const page = readFileSync(at('../../../../../docs/page.md'), 'utf8');
  const listed = /\| area \|[^\n]*\n\|[-| ]+\n((?:\|[^\n]*\n)+)/.exec(page)?.[1] ?? '';
  expect([...listed.matchAll(/^\| `([\w-]+)`/gm)].map(([, name]) => name).sort()).toEqual(areas);
});

test('each part of the page names its area, once, in a style sheet of its own', () => {
  expect(standing.length).toBeGreaterThan(10);
  const rules = panelSheets.flatMap(({ css }) => rulesOf(css));
  for (const id of standing) {
    const named = rules
      .filter(({ selector }) => selector.split(',').some((each) => each.trim() === `#${id}`))
      .flatMap(({ body }) => /grid-area: ([^;]*);/.exec(body)?.[1] ?? []);
    expect(named.length, id).toBe(1);
    // The red edge is around all of the screen.
    if (id !== 'blocked-edge') expect(areas, id).toContain(named[0]);
  }
});

test('no panel says itself where on the screen it is', () => {
  for (const { name, css } of panelSheets) {
    expect(css, name).not.toMatch(/position: fixed/);
    expect(css, name).not.toMatch(/(^|\n)\s*body \{[^}]*grid-template/);
    for (const { selector, body } of rulesOf(css)) {
      const [, last = ''] = /#([\w-]+)$/.exec(selector) ?? [];
      if (!standing.includes(last)) continue;
      expect(body, `${name}: ${selector}`).not.toMatch(/(^|[;\s])(top|right|bottom|left|inset[\w-]*):/);
    }
  }
  // A dialog stands over the grid, where the browser centres it.
  const fixed = rulesOf(layout).filter(({ body }) => body.includes('position: fixed'));
  expect(fixed.map(({ selector }) => selector)).toEqual(['dialog']);
});
