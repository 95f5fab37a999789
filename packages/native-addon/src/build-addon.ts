/**
 * Builds a Node-API addon or a program with node-gyp if its sources have changed. Node's headers come from the Node that runs this
 * if it includes them, or from the system; only if there are none does node-gyp download them.
 */
import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, readdirSync, readFileSync, realpathSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { delimiter, dirname, join } from 'node:path';

export interface BuildResult {
  ok: boolean;
  /** Output of the tools, if the build failed. */
  output: string;
}

export interface NativeAddon {
  /** Folder of its `binding.gyp` and its sources. */
  folder: string;
  /** The target's name in `binding.gyp`. */
  name: string;
  /** Further folders with C sources of which it is built. */
  shared?: readonly string[];
  /** Further dependencies of the build: environment, versions of libraries. */
  depends?: string;
  /** What is built: an addon, or a program of its own. */
  kind?: 'addon' | 'program';
}

/** Header files shared by the addons' C sources. Each `binding.gyp` finds them through this package. */
export const INCLUDE_FOLDER = join(import.meta.dirname, '..', 'include');

/** Where the built addon or program is. */
export function addonFile({ folder, name, kind = 'addon' }: NativeAddon): string {
  return join(folder, 'build', 'Release', kind === 'addon' ? `${name}.node` : name);
}

/** Builds the addon if it is missing or its sources have changed. */
export function buildNativeAddon(addon: NativeAddon): BuildResult {
  const { folder } = addon;
  const stampFile = join(folder, 'build', 'sources.sha256');
  const stamp = sourcesHash(addon);
  if (existsSync(addonFile(addon)) && existsSync(stampFile) && readFileSync(stampFile, 'utf8') === stamp)
    return { ok: true, output: '' };
  const gyp = createRequire(import.meta.url).resolve('node-gyp/bin/node-gyp.js');
  const headers = findNodeHeaders();
  const { status, stdout, stderr, error } = spawnSync(
    process.execPath,
    [gyp, 'rebuild', '--release', ...(headers === null ? [] : [`--nodedir=${headers}`])],
    {
      cwd: folder,
      encoding: 'utf8',
      // The `node` that `binding.gyp` runs to find folders is this one.
      env: { ...process.env, PATH: `${dirname(process.execPath)}${delimiter}${process.env.PATH ?? ''}` },
    },
  );
  if (status !== 0) return { ok: false, output: `${stdout}${stderr}${error?.message ?? ''}` };
  writeFileSync(stampFile, stamp);
  return { ok: true, output: '' };
}

/** A folder with `include/node/node_api.h`, or `null`. Node-API is stable, so the headers of another Node will do. */
export function findNodeHeaders(): string | null {
  const program = dirname(dirname(realpathSync(process.execPath)));
  const carried = join(program, 'node_modules');
  const candidates = [
    process.env.npm_config_nodedir,
    program,
    // The npm package `node` has the distribution for this machine in a package of its own.
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

function sourcesHash({ folder, shared = [], depends = '' }: NativeAddon): string {
  const hash = createHash('sha256').update(`${process.platform} ${process.arch}\n${depends}\n`);
  for (const from of [folder, ...shared, INCLUDE_FOLDER]) {
    for (const name of readdirSync(from).sort())
      if (/\.(c|h|gyp)$/.test(name)) hash.update(name).update(readFileSync(join(from, name)));
  }
  return hash.digest('hex');
}
