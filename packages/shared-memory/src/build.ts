/**
 * Builds the addon with node-gyp: `node packages/shared-memory/src/build.ts`. Node's headers are taken from the Node that
 * runs this where it carries them, or from the system; only where there are none does node-gyp fetch them.
 */
import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, readdirSync, readFileSync, realpathSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';

const NATIVE_FOLDER = join(import.meta.dirname, '..', 'native');
export const ADDON_FILE = join(NATIVE_FOLDER, 'build', 'Release', 'farpoint_shared_memory.node');
const STAMP_FILE = join(NATIVE_FOLDER, 'build', 'sources.sha256');

/** How to get what the build needs. */
export const BUILD_REMEDY =
  'install a C compiler, make and Python 3 (Debian: `apt-get install build-essential python3`) and run `pnpm build:native`';

export interface BuildResult {
  ok: boolean;
  /** What the tools said, where it failed. */
  output: string;
}

/** Builds it where its sources have changed since the last time, or it is not there. */
export function buildAddon(): BuildResult {
  if (process.platform !== 'linux') return { ok: false, output: 'shared memory needs Linux' };
  const stamp = sourcesHash();
  if (existsSync(ADDON_FILE) && existsSync(STAMP_FILE) && readFileSync(STAMP_FILE, 'utf8') === stamp)
    return { ok: true, output: '' };
  const gyp = createRequire(import.meta.url).resolve('node-gyp/bin/node-gyp.js');
  const headers = findNodeHeaders();
  const { status, stdout, stderr, error } = spawnSync(
    process.execPath,
    [gyp, 'rebuild', '--release', ...(headers === null ? [] : [`--nodedir=${headers}`])],
    { cwd: NATIVE_FOLDER, encoding: 'utf8' },
  );
  if (status !== 0) return { ok: false, output: `${stdout}${stderr}${error?.message ?? ''}` };
  writeFileSync(STAMP_FILE, stamp);
  return { ok: true, output: '' };
}

/** A folder with `include/node/node_api.h`, or `null`. Node-API is stable: headers of another Node serve as well. */
function findNodeHeaders(): string | null {
  const program = dirname(dirname(realpathSync(process.execPath)));
  const carried = join(program, 'node_modules');
  const candidates = [
    process.env.npm_config_nodedir,
    program,
    // The npm package `node` keeps the distribution for this machine in a package of its own.
    ...(existsSync(carried) ? readdirSync(carried).map((name) => join(carried, name)) : []),
    '/usr',
    '/usr/local',
  ];
  return (
    candidates.find(
      (folder): folder is string =>
        folder !== undefined && existsSync(join(folder, 'include', 'node', 'node_api.h')),
    ) ?? null
  );
}

function sourcesHash(): string {
  const hash = createHash('sha256').update(`${process.platform} ${process.arch}\n`);
  for (const name of readdirSync(NATIVE_FOLDER).sort()) {
    if (/\.(c|h|gyp)$/.test(name)) hash.update(name).update(readFileSync(join(NATIVE_FOLDER, name)));
  }
  return hash.digest('hex');
}

if (import.meta.main) {
  const { ok, output } = buildAddon();
  if (ok) console.log(`built ${ADDON_FILE}`);
  else {
    console.error(`${output.trimEnd()}\nthe shared-memory addon could not be built: ${BUILD_REMEDY}`);
    process.exitCode = 1;
  }
}
