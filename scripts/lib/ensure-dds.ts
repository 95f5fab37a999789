import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { aptInstall } from './apt-install.ts';
import { root, run } from './run.ts';

/**
 * A Python with its own DDS, which the tests use as another implementation; `FARPOINT_DDS_PYTHON` names another one.
 */
const FOLDER = join(root, '.farpoint', 'python-dds');

/** Installs CycloneDDS, on which the addon is built, if possible. */
export async function ensureCycloneDds(say: (line: string) => void): Promise<void> {
  if (process.env.CYCLONEDDS_HOME !== undefined || (await compiles('c', '#include <dds/dds.h>'))) return;
  await aptInstall('cyclonedds-dev', say);
}

/**
 * Installs the other DDS implementations for the tests: Fast DDS and Python's. Tests that need a missing one say so.
 */
export async function ensureDdsPeers(say: (line: string) => void): Promise<void> {
  const fastDds = '#include <fastdds/dds/domain/DomainParticipant.hpp>';
  if (!(await compiles('c++', fastDds))) await aptInstall('libfastrtps-dev', say);
  if (!(await compiles('c++', fastDds)))
    say('Fast DDS is missing: its tests are skipped (apt-get install libfastrtps-dev g++)');
  const candidates = [process.env.FARPOINT_DDS_PYTHON, join(FOLDER, 'bin', 'python3'), 'python3'];
  for (const python of candidates) if (python !== undefined && (await hasCyclone(python))) return;
  if (!existsSync(FOLDER)) {
    say('DDS for Python is missing; fetching it for the tests');
    await run('python3', ['-m', 'venv', FOLDER], { timeoutMs: 60_000 });
    const pip = join(FOLDER, 'bin', 'pip');
    await run(
      pip,
      ['install', '--quiet', '--disable-pip-version-check', '--only-binary', ':all:', 'cyclonedds'],
      {
        timeoutMs: 180_000,
      },
    );
  }
  if (!(await hasCyclone(join(FOLDER, 'bin', 'python3'))))
    say('DDS for Python is missing: its tests are skipped (pip install cyclonedds)');
}

async function compiles(language: 'c' | 'c++', source: string): Promise<boolean> {
  const check = `echo '${source}' | ${language === 'c' ? 'cc' : 'c++'} -E -x ${language} - -o /dev/null`;
  return (await run('sh', ['-c', check])).code === 0;
}

async function hasCyclone(python: string): Promise<boolean> {
  return (await run(python, ['-c', 'import cyclonedds.domain'])).code === 0;
}
