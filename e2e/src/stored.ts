/** What a page finds in its browser, as if somebody had chosen it on an earlier visit. */
import type { Page } from '@playwright/test';

/** By its key in the browser. */
export type Stored = Readonly<Record<string, Readonly<Record<string, unknown>>>>;

/** The stored choice that clouds of depth cameras are drawn as surfaces, which a software renderer does not by default. */
export const SURFACES: Stored = { 'farpoint.clouds': { surface: true } };
/** The same, and that nothing is remembered. */
export const SURFACES_ALONE: Stored = { 'farpoint.clouds': { surface: true, memory: false } };

/** Call it before the page loads. */
export async function keep(page: Page, stored: Stored): Promise<void> {
  await page.addInitScript((stored) => {
    // A page that has been reloaded keeps what it was told since.
    for (const [key, value] of Object.entries(stored)) localStorage[key] ??= JSON.stringify(value);
  }, stored);
}
