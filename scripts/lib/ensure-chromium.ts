import { findChromium } from '@farpoint/local-stack';
import { rootCommand } from './root-command.ts';
import { run } from './run.ts';

/**
 * Finds a Chromium, or installs one: Playwright's own, else the distribution's package.
 *
 * @returns its path, or `null` where neither could be installed
 */
export async function ensureChromium(say: (line: string) => void): Promise<string | null> {
  const found = findChromium();
  if (found !== null) return found;
  say('no Chromium here; fetching the one that Playwright keeps');
  // Its download is tried once: where its server is out of reach, the distribution's package serves as well.
  const env = { PLAYWRIGHT_DOWNLOAD_CONNECTION_TIMEOUT: '10000' };
  const fetched = await run('pnpm', ['--dir', 'e2e', 'exec', 'playwright', 'install', 'chromium'], {
    env,
    timeoutMs: 300_000,
  });
  if (fetched.code === 0 && (await starts(findChromium()))) return findChromium();
  const asRoot = rootCommand();
  if (asRoot !== null && (await run('apt-get', ['--version'])).code === 0) {
    say('installing the package chromium');
    const command = [...asRoot, 'apt-get'];
    const program = command[0] ?? 'apt-get';
    const args = command.slice(1);
    await run(program, [...args, 'update']);
    await run(program, [...args, 'install', '-y', '--no-install-recommends', 'chromium'], {
      env: { DEBIAN_FRONTEND: 'noninteractive' },
    });
  }
  const installed = findChromium();
  return (await starts(installed)) ? installed : null;
}

/** A browser that lacks its libraries is there but does not start. */
async function starts(path: string | null): Promise<boolean> {
  return path !== null && (await run(path, ['--version'], { timeoutMs: 30_000 })).code === 0;
}
