import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect } from './expect.ts';

/**
 * Expects that axe finds nothing against WCAG 2.2 A and AA, and nothing against its best practices.
 *
 * @param without selects what is looked at elsewhere: pages in frames, whose names axe compares with each other
 */
export async function expectAccessible(page: Page, screen: string, without?: string): Promise<void> {
  const axe = new AxeBuilder({ page });
  const { violations } = await (without === undefined ? axe : axe.exclude(without)).analyze();
  const found = violations.flatMap(({ id, help, nodes }) =>
    nodes.map(({ target, failureSummary }) => `${id}: ${help}: ${target.join(' ')}: ${failureSummary}`),
  );
  expect.soft(found, screen).toEqual([]);
}
