/** The page's layout: each panel stands in the area that it names, and what is empty belongs to the picture. */
import type { StageStateName } from '@farpoint/webxr/stage-states';
import type { Page } from '@playwright/test';
import { expect, test } from '../src/stage/page-test.ts';

/** Which area each part of the page has on a usual screen. */
const AREAS: Readonly<Record<string, string>> = {
  world: 'world',
  bar: 'bar',
  'stop-band': 'band',
  hud: 'figures',
  side: 'side',
  messages: 'messages',
  drive: 'controls',
  stop: 'stop',
  dashboard: 'dashboard',
  robots: 'middle',
  obstacle: 'middle',
};
const SCREENS = [
  [1280, 720],
  [3840, 2160],
  [960, 540],
  [360, 740],
  [667, 320],
  [640, 360],
  [320, 180],
] as const;
const STATES: readonly { state: StageStateName; open?: string }[] = [
  { state: 'fleet' },
  { state: 'not-granted' },
  { state: 'driving' },
  { state: 'stop-latched', open: '#dashboard-open' },
  { state: 'alarm', open: '#dashboard-open' },
  { state: 'commands', open: '#commands summary' },
  { state: 'videos' },
  { state: 'link-lost' },
  { state: 'everything', open: '#commands summary' },
];
/** Parts in order, so that one does not reach into the next: above or left of it. */
const APART = [
  ['bar', 'hud'],
  ['bar', 'side'],
  ['stop-band', 'hud'],
  ['stop-band', 'side'],
  ['stop-band', 'stop'],
  ['hud', 'side'],
  ['side', 'drive'],
  ['side', 'stop'],
  ['side', 'dashboard'],
] as const;

interface Standing {
  readonly id: string;
  /** From the computed style, without the ends of its lines' names. */
  readonly area: string;
  /** By how much the part is outside its area, CSS pixels; at most 0 if it is within. */
  readonly outside: number;
  readonly box: readonly [left: number, top: number, right: number, bottom: number];
}

/** Where everything is that stands on the page itself. An empty element in the same area says how large that is. */
function standing(page: Page): Promise<Standing[]> {
  return page.evaluate(() => {
    const parts = [...document.body.children].filter(
      (part): part is HTMLElement =>
        part instanceof HTMLElement && part.tagName !== 'DIALOG' && part.checkVisibility(),
    );
    return parts
      .filter(({ id }) => id !== '' && id !== 'blocked-edge')
      .map((part) => {
        const { gridRowStart, gridRowEnd, gridColumnStart, gridColumnEnd } = getComputedStyle(part);
        const probe = document.createElement('i');
        Object.assign(probe.style, { gridRowStart, gridRowEnd, gridColumnStart, gridColumnEnd });
        probe.style.contain = 'strict';
        document.body.append(probe);
        const area = probe.getBoundingClientRect();
        probe.remove();
        const { left, top, right, bottom } = part.getBoundingClientRect();
        const outside = [area.left - left, area.top - top, right - area.right, bottom - area.bottom];
        const names = new Set([gridRowStart, gridRowEnd, gridColumnStart, gridColumnEnd]);
        return {
          ...{ id: part.id, area: [...names].join(' '), outside: Math.max(...outside) },
          box: [left, top, right, bottom] as const,
        };
      });
  });
}

/** What is hit over the page, that is neither the picture nor anything that is seen. */
function emptyHits(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const found = new Set<string>();
    const world = document.getElementById('world')?.getBoundingClientRect() ?? new DOMRect();
    const boxes = ['hud', 'side', 'messages', 'drive', 'stop', 'stop-band', 'drive-state', 'drive-right'];
    for (let x = 0.025; x < 1; x += 0.05)
      for (let y = 0.025; y < 1; y += 0.05) {
        const hit = document.elementFromPoint(x * world.width, y * world.height);
        if (hit === null || hit === document.body || hit === document.documentElement) found.add('nothing');
        else if (boxes.includes(hit.id)) found.add(hit.id);
      }
    return [...found];
  });
}

/** What reaches beyond the end of the column at the right, instead of giving way. */
function overflowing(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const end = document.getElementById('side')?.getBoundingClientRect().bottom ?? 0;
    return [...document.querySelectorAll('#side > *')]
      .filter((part) => part.checkVisibility() && part.getBoundingClientRect().bottom > end + 0.5)
      .map(({ id }) => id);
  });
}

for (const { state, open } of STATES)
  test(`each part stands in its area: ${state}${open === undefined ? '' : ` with ${open}`}`, async ({
    stage,
  }) => {
    const page = await stage.open({ state, canvas: '64x36', forMs: 2500 });
    for (const [i, [width, height]] of SCREENS.entries()) {
      await stage.resize(width, height);
      if (i === 0 && open !== undefined) {
        await page.locator(open).click();
        if (open === '#dashboard-open') await page.locator('#dashboard').waitFor();
      }
      const parts = await standing(page);
      const on = `${state} on ${width} × ${height}`;
      expect(
        parts.map(({ id }) => id),
        on,
      ).toEqual(expect.arrayContaining(['world', 'bar']));
      for (const { id, outside } of parts) expect(outside, `${id}: ${on}`).toBeLessThanOrEqual(0.5);
      if (i === 0)
        for (const { id, area } of parts) expect(area, `${id}: ${on}`).toContain(AREAS[id] ?? 'unknown');
      for (const [one, other] of APART) {
        const [a, b] = [one, other].map((id) => parts.find((part) => part.id === id)?.box);
        if (a === undefined || b === undefined || a[2] === a[0] || b[2] === b[0]) continue;
        const isApart = a[2] <= b[0] + 0.5 || a[3] <= b[1] + 0.5;
        expect(isApart, `${one} and ${other}: ${on}`).toBe(true);
      }
      expect(await emptyHits(page), on).toEqual([]);
      expect(await overflowing(page), on).toEqual([]);
    }
  });

test('on a laptop all figures and all commands are read at once, without scrolling', async ({ stage }) => {
  const page = await stage.open({ state: 'commands', canvas: '64x36' });
  await stage.resize(1280, 720);
  await page.locator('#commands summary').click();
  await stage.run(500);
  await expect(page.locator('#commands').getByRole('button', { name: 'Lights' })).toBeInViewport();
  for (const id of ['facts', 'hud', 'commands']) {
    const hidden = await page
      .locator(`#${id}`)
      .evaluate(({ scrollHeight, clientHeight }) => scrollHeight - clientHeight);
    expect(hidden, id).toBeLessThanOrEqual(1);
  }
  expect(await page.locator('#facts dd').count()).toBeGreaterThan(8);
});
