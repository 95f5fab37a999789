import { aptInstall } from './apt-install.ts';
import { run } from './run.ts';

/** Finds coturn, or installs it. The test that needs it says so if it is missing. */
export async function ensureTurnServer(say: (line: string) => void): Promise<void> {
  if (await isThere()) return;
  await aptInstall('coturn', say);
  if (!(await isThere())) say('turnserver is missing: the relay test is skipped (apt-get install coturn)');
}

async function isThere(): Promise<boolean> {
  return (await run('turnserver', ['--version'])).code !== 127;
}
