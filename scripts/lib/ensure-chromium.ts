import { findChromium } from '@farpoint/local-stack';
import { aptInstall } from './apt-install.ts';
import { run } from './run.ts';

/**
 * Finds a Chromium or installs one: Playwright's own, or else the distribution's package.
 *
 * @returns its path, or `null` if neither could be installed
 */
export async function ensureChromium(say: (line: string) => void): Promise<string | null> {
  const found = findChromium();
  if (found !== null) return found;
  say('Chromium is missing; fetching Playwright’s');
  // Its download is tried once. If the server is out of reach, the distribution's package will do.
  const env = { PLAYWRIGHT_DOWNLOAD_CONNECTION_TIMEOUT: '10000' };
  const fetched = await run('pnpm', ['--dir', 'e2e', 'exec', 'playwright', 'install', 'chromium'], {
    env,
    timeoutMs: 300_000,
  });
  if (fetched.code === 0 && (await starts(findChromium()))) return findChromium();
  await aptInstall('chromium', say);
  const installed = findChromium();
  return (await starts(installed)) ? installed : null;
}

/** A browser that lacks libraries exists but does not start. */
async function starts(path: string | null): Promise<boolean> {
  return path !== null && (await run(path, ['--version'], { timeoutMs: 30_000 })).code === 0;
}
