import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { parse } from 'yaml';
import { alertRules } from './alerts.ts';
import { grafanaDashboard } from './dashboard.ts';
import { dashboards } from './dashboards.ts';
import { files } from './files.ts';

test.each([...files()])(
  '%s is what its source says (pnpm --filter @farpoint/observability run write)',
  (path, text) => {
    expect(readFileSync(new URL(`../${path}`, import.meta.url), 'utf8')).toBe(text);
  },
);

interface Placed {
  id: number;
  gridPos: { x: number; y: number; w: number; h: number };
}

describe.each(
  dashboards.map((each) => [each.title, grafanaDashboard(each) as { panels: Placed[] }] as const),
)('%s', (_, { panels }) => {
  test('has panels of different numbers, side by side and below each other', () => {
    expect(new Set(panels.map(({ id }) => id)).size).toBe(panels.length);
    const taken = new Set<string>();
    for (const { gridPos: at } of panels)
      for (let x = at.x; x < at.x + at.w; x++)
        for (let y = at.y; y < at.y + at.h; y++) {
          expect(taken.has(`${x} ${y}`)).toBe(false);
          expect(x).toBeLessThan(24);
          taken.add(`${x} ${y}`);
        }
  });
});

test('each alert says what is wrong, and what to do first', () => {
  const { groups } = parse(files().get('prometheus/alerts.yaml') ?? '') as {
    groups: { rules: { alert: string; annotations: object }[] }[];
  };
  expect(groups.flatMap(({ rules }) => rules.map(({ alert }) => alert))).toEqual(
    alertRules.map(({ name }) => name),
  );
  for (const { summary, action } of alertRules) {
    expect(summary).toMatch(/\$labels\..*\.$/);
    expect(action).toMatch(/^[A-Z].*\.$/);
  }
});
