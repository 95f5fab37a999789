import { AxeBuilder } from '@axe-core/playwright';
import { expect } from '@playwright/test';
import type { Stage } from './stage.ts';

/** WCAG 2.2 A and AA, and what axe knows beside it to be good. */
const RULES = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22a', 'wcag22aa', 'best-practice'];

/** Expects that axe finds nothing wrong with the page as it is now. @param screen what is on it */
export async function expectAccessible(stage: Stage, screen: string): Promise<void> {
  let isOver = false;
  // In the page itself: another one of the same browser would stand still, too.
  const audit = new AxeBuilder({ page: stage.page }).setLegacyMode(true).withTags(RULES).analyze();
  const over = audit.finally(() => {
    isOver = true;
  });
  // It waits on the page's clock, which only tests move on.
  while (!isOver) await stage.run(250);
  const { violations } = await over;
  const found = violations.flatMap(({ id, nodes }) =>
    nodes.map(({ target, failureSummary }) => `${id}: ${target.join(' ')}: ${failureSummary}`),
  );
  expect.soft(found, screen).toEqual([]);
}
