/** The screens on which tests look at the page. */

/** Whether tests save the pictures that they do not need themselves: set by `pnpm test --all`, or by hand. */
export const savesScreenshots = (process.env.FARPOINT_SCREENSHOTS ?? '') !== '';

/** At which every screen should be looked at. */
export const screenSizes = [
  { width: 360, height: 740 },
  { width: 1280, height: 720 },
  { width: 3840, height: 2160 },
] as const;

/** In the page: two display frames from now, or a while if the page gets none. */
export function shownOrLate(): Promise<void> {
  return new Promise((resolve) => {
    setTimeout(resolve, 300);
    requestAnimationFrame(() => requestAnimationFrame(() => resolve()));
  });
}
