import type { Page } from '@playwright/test';

/**
 * Stops a page's display frames, as a hung compositor or graphics processor does. Its timers and events go on.
 *
 * @returns when the page was last given a frame, ms since it loaded
 */
export async function freezeFrames(page: Page): Promise<number> {
  return page.evaluate(
    () =>
      new Promise<number>((resolve) => {
        const request = window.requestAnimationFrame;
        const held: FrameRequestCallback[] = [];
        window.thawFrames = () => {
          window.requestAnimationFrame = request;
          for (const callback of held) request.call(window, callback);
        };
        // In the frame in which it is called: the page has just read its devices for the last time.
        request.call(window, () => {
          window.requestAnimationFrame = (callback) => held.push(callback);
          setTimeout(() => resolve(performance.now()));
        });
      }),
  );
}

/** Lets the frames go on. */
export async function thawFrames(page: Page): Promise<void> {
  await page.evaluate(() => window.thawFrames?.());
}

declare global {
  interface Window {
    thawFrames?: () => void;
  }
}
