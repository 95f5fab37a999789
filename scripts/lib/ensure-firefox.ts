import { findFirefox, findProgram, firefoxMissing, firefoxNeedsDisplay } from '@farpoint/local-stack';
import { aptInstall } from './apt-install.ts';

/**
 * Finds Firefox, and on Linux a display for it, or installs them.
 *
 * @returns what is still missing, with its remedy, or `null`
 */
export async function ensureFirefox(say: (line: string) => void): Promise<string | null> {
  if (findFirefox() === null) await aptInstall('firefox-esr', say);
  if (findFirefox() !== null && firefoxNeedsDisplay && findProgram(['Xvfb']) === null) {
    await aptInstall('xvfb', say);
  }
  return firefoxMissing();
}
