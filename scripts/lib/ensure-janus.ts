import { findJanus, JANUS_REMEDY } from '@farpoint/local-stack';
import { aptInstall } from './apt-install.ts';

/** Finds Janus, or installs it. The tests that need it say so if it is missing. */
export async function ensureJanus(say: (line: string) => void): Promise<void> {
  if (findJanus() !== null) return;
  await aptInstall('janus', say);
  if (findJanus() === null) say(`Janus is missing: the tests of broadcasts are skipped (${JANUS_REMEDY})`);
}
