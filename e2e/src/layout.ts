import type { Locator } from '@playwright/test';
import { expect } from './expect.ts';

/**
 * Expects that each of the elements is entirely on the screen, and that none covers another. An
 * element that has gone by the time its place is read (a notice that fades, say) covers nothing.
 *
 * @returns their ids
 */
export async function expectOnScreenAndApart(
  elements: Locator,
  screen: { width: number; height: number },
): Promise<string[]> {
  const boxes = await elements.evaluateAll((found) =>
    found
      .filter((element) => element.checkVisibility())
      .map((element) => {
        const { left, top, right, bottom } = element.getBoundingClientRect();
        return { name: element.id, left, top, right, bottom };
      }),
  );
  for (const [i, box] of boxes.entries()) {
    expect(box.right, box.name).toBeLessThanOrEqual(screen.width);
    expect(box.left, box.name).toBeGreaterThanOrEqual(0);
    expect(box.bottom, box.name).toBeLessThanOrEqual(screen.height);
    expect(box.right - box.left, box.name).toBeGreaterThan(24);
    for (const other of boxes.slice(i + 1)) {
      const apart =
        box.right <= other.left ||
        other.right <= box.left ||
        box.bottom <= other.top ||
        other.bottom <= box.top;
      expect(apart, `${box.name} and ${other.name}`).toBe(true);
    }
  }
  return boxes.map(({ name }) => name);
}
