/** The screens on which tests look at the page, and the pictures that they save for people. */

/** Whether tests save pictures that only people look at: set by `pnpm test --pictures`, or by hand. */
export const savesPictures = (process.env.FARPOINT_PICTURES ?? '') !== '';

const PHONE = { width: 360, height: 740 };
export const LAPTOP = { width: 1280, height: 720 };
const LARGE = { width: 3840, height: 2160 };

/**
 * At which every screen should be looked at. The largest one is drawn for people only: a software renderer takes
 * seconds for each of its pictures, and no test looks at its pixels.
 */
export const screenSizes = savesPictures ? [PHONE, LAPTOP, LARGE] : [PHONE, LAPTOP];
