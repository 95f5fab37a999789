import type { Page } from '@playwright/test';
import { expect } from './expect.ts';

/** Expects that no panel covers the bar, the emergency stop or anything else that the hands use. */
export async function expectNothingCovered(page: Page): Promise<void> {
  const covered = await page.evaluate(() => {
    const boxes = (selector: string) =>
      [...document.querySelectorAll(selector)]
        .map((element) => ({ name: element.id, ...element.getBoundingClientRect().toJSON() }))
        .filter(({ width }) => width > 0);
    const strip = document.querySelector('#pictures')!.getBoundingClientRect();
    const panels = [...document.querySelectorAll<HTMLElement>('#pictures figure')].map((figure) => {
      const { left, top, right, bottom } = figure.getBoundingClientRect();
      // What is in the strip is cut off at its ends.
      const inStrip = figure.dataset.floating !== 'true' && figure.dataset.enlarged !== 'true';
      return {
        name: figure.ariaLabel,
        left,
        top: inStrip ? Math.max(top, strip.top) : top,
        right,
        bottom: inStrip ? Math.min(bottom, strip.bottom) : bottom,
      };
    });
    return boxes('#bar, #drive button, #joystick').flatMap((kept) =>
      panels
        .filter(
          ({ left, top, right, bottom }) =>
            left < kept.right && right > kept.left && top < kept.bottom && bottom > kept.top,
        )
        .map(({ name }) => `${name} covers ${kept.name}`),
    );
  });
  expect(covered).toEqual([]);
  // Whatever fills the screen, the button is what a hand hits.
  const hit = await page.evaluate(() => {
    const { left, top, width, height } = document.querySelector('#estop')!.getBoundingClientRect();
    return document.elementFromPoint(left + width / 2, top + height / 2)?.closest('button')?.id;
  });
  expect(hit).toBe('estop');
}
