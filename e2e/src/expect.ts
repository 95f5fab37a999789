import { expect as playwrightExpect } from '@playwright/test';

/** How long `expect.poll` waits between two looks, ms. Playwright's own waits grow to a second. */
const INTERVALS_MS = [20, 50, 100];

const poll: typeof playwrightExpect.poll = (actual, options) =>
  playwrightExpect.poll(actual, {
    intervals: INTERVALS_MS,
    ...(typeof options === 'string' ? { message: options } : options),
  });

/** Playwright's `expect`, which looks often: most of what a test waits for comes within a second. */
export const expect: typeof playwrightExpect = new Proxy(playwrightExpect, {
  get: (target, name) => (name === 'poll' ? poll : Reflect.get(target, name)),
});
