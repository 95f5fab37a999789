/** Installs what the tests need and is missing: in one round of apt and one of pip, tried three times. */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { rootCommand, run } from '../lib/run.ts';
import type { Need } from './needs.ts';

const TRIES = 3;
const APT_MS = 600_000;
const PIP_MS = 180_000;

/** @returns those that are still missing */
export async function provision(needs: readonly Need[], say: (line: string) => void): Promise<Need[]> {
  const missing = await missingOf(needs);
  if (missing.length === 0) return [];
  say(`missing here: ${missing.map(({ name }) => name).join(', ')}`);
  const fetched = missing.filter(({ fetch }) => fetch !== undefined);
  await Promise.all(fetched.map(({ fetch }) => fetch?.()));
  const unfetched = await missingOf(fetched);
  const there = new Set(fetched.filter((need) => !unfetched.includes(need)));
  await aptInstall(
    missing.filter((need) => !there.has(need)).flatMap(({ packages }) => packages),
    say,
  );
  // A virtual environment needs a Python that apt may just have installed.
  await Promise.all(missing.map((need) => pipInstall(need, say)));
  return missingOf(missing);
}

async function missingOf(needs: readonly Need[]): Promise<Need[]> {
  const there = await Promise.all(needs.map((need) => need.isThere()));
  return needs.filter((_, i) => there[i] !== true);
}

/** All at once or, where that fails, one by one, so that a package that is not to be had keeps no other away. */
async function aptInstall(names: readonly string[], say: (line: string) => void): Promise<void> {
  const asRoot = rootCommand();
  if (names.length === 0 || asRoot === null || (await run('apt-get', ['--version'])).code !== 0) return;
  const [program = 'apt-get', ...before] = [...asRoot, 'apt-get'];
  const apt = async (...args: string[]): Promise<boolean> => {
    const env = { DEBIAN_FRONTEND: 'noninteractive' };
    return (await run(program, [...before, ...args], { env, timeoutMs: APT_MS })).code === 0;
  };
  const install = (...some: string[]) => apt('install', '-y', '--no-install-recommends', ...some);
  say(`apt-get install ${names.join(' ')}`);
  for (let time = 1; time <= TRIES; time++) {
    const isUpdated = await apt('update');
    if (await install(...names)) return;
    if (isUpdated) break;
    say(`apt-get failed (${time} of ${TRIES})`);
  }
  for (const name of names) await install(name);
}

async function pipInstall({ python, name }: Need, say: (line: string) => void): Promise<void> {
  if (python === undefined) return;
  const { folder, install } = python;
  if (!existsSync(folder)) await run('python3', ['-m', 'venv', folder], { timeoutMs: PIP_MS });
  for (let time = 1; time <= TRIES; time++) {
    const args = ['install', '--quiet', '--disable-pip-version-check', ...install];
    if ((await run(join(folder, 'bin', 'pip'), args, { timeoutMs: PIP_MS })).code === 0) return;
    say(`pip could not install ${name} (${time} of ${TRIES})`);
  }
}

/** Debian's versions of packages, for what is remembered of tests that used them. */
export async function versionsOf(packages: readonly string[]): Promise<string[]> {
  if (packages.length === 0) return [];
  // Tab-separated by default: package and version.
  const { output } = await run('dpkg-query', ['-W', ...packages]);
  return output
    .split('\n')
    .filter((line) => /^\S+\t\S+$/.test(line))
    .sort();
}
