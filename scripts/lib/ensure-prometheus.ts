import { findProgram } from '@farpoint/local-stack';
import { aptInstall } from './apt-install.ts';

/** Finds Prometheus, or installs it. The tests that need it say so if it is missing. */
export async function ensurePrometheus(say: (line: string) => void): Promise<void> {
  const isThere = () => findProgram(['promtool']) !== null && findProgram(['prometheus']) !== null;
  if (isThere()) return;
  await aptInstall('prometheus', say);
  if (!isThere())
    say('Prometheus is missing: the tests of dashboards and alerts are skipped (apt-get install prometheus)');
}
