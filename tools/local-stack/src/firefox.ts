import { existsSync } from 'node:fs';
import { findProgram } from './chromium.ts';

/** The command that installs a missing browser. */
const FIREFOX_REMEDY = 'apt-get install firefox-esr xvfb';

const OTHER_PLACES = [
  '/Applications/Firefox.app/Contents/MacOS/firefox',
  'C:\\Program Files\\Mozilla Firefox\\firefox.exe',
];

/**
 * The second browser for tests: `FARPOINT_FIREFOX`, else one installed on this machine.
 *
 * @returns its path, or `null` if there is none
 */
export function findFirefox(): string | null {
  const named = process.env.FARPOINT_FIREFOX;
  if (named !== undefined && named !== '') return existsSync(named) ? named : null;
  return findProgram(['firefox-esr', 'firefox'], OTHER_PLACES);
}

/** On Linux, Firefox has WebGL only on a display, though one without a screen suffices. */
export const firefoxNeedsDisplay = process.platform === 'linux';

/** @returns what prevents testing with Firefox here, with its remedy, or `null` */
export function firefoxMissing(): string | null {
  const missing =
    findFirefox() === null
      ? 'no Firefox'
      : firefoxNeedsDisplay && findProgram(['Xvfb']) === null
        ? 'no Xvfb for Firefox'
        : null;
  return missing === null ? null : `${missing} here: its tests are skipped (${FIREFOX_REMEDY})`;
}
