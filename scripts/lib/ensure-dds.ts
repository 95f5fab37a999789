import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { aptInstall } from './apt-install.ts';
import { root, run } from './run.ts';

/** Python with a DDS of its own, which the tests take as another maker's; `FARPOINT_DDS_PYTHON` names another. */
const FOLDER = join(root, '.farpoint', 'python-dds');

/** CycloneDDS, which the addon is built over, where it can be installed. */
export async function ensureCycloneDds(say: (line: string) => void): Promise<void> {
  if (process.env.CYCLONEDDS_HOME !== undefined || (await compiles('c', '#include <dds/dds.h>'))) return;
  await aptInstall('cyclonedds-dev', say);
}

/** The other makers' DDS that the tests speak to: Fast DDS and Python's. The tests that need them say so where they are missing. */
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
