import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { root, run } from './run.ts';

/** Folder of the tests' own Python; `FARPOINT_PYTHON` names another one. */
const FOLDER = join(root, '.farpoint', 'python');

/** Finds a Python with numpy, or makes one. Tests that need it say so if it is missing. */
export async function ensureNumpy(say: (line: string) => void): Promise<void> {
  const candidates = [process.env.FARPOINT_PYTHON, join(FOLDER, 'bin', 'python3'), 'python3'];
  for (const python of candidates) if (python !== undefined && (await hasNumpy(python))) return;
  if (!existsSync(FOLDER)) {
    say('numpy is missing; fetching it for the tests of the Python producer');
    await run('python3', ['-m', 'venv', FOLDER], { timeoutMs: 60_000 });
    const pip = join(FOLDER, 'bin', 'pip');
    await run(pip, ['install', '--quiet', '--disable-pip-version-check', 'numpy'], { timeoutMs: 180_000 });
  }
  if (!(await hasNumpy(join(FOLDER, 'bin', 'python3'))))
    say('numpy is missing: the tests of the Python producer are skipped (apt-get install python3-numpy)');
}

async function hasNumpy(python: string): Promise<boolean> {
  return (await run(python, ['-c', 'import numpy'])).code === 0;
}
