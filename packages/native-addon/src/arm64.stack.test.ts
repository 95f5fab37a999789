/**
 * The addons for a Jetson: compiled for arm64 without a warning, if the compiler is installed (Debian:
 * gcc-aarch64-linux-gnu).
 */
import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import { findNodeHeaders, INCLUDE_FOLDER } from './build-addon.ts';

const compiler = 'aarch64-linux-gnu-gcc';
const packages = join(import.meta.dirname, '..', '..');
const headers = findNodeHeaders();
const here = spawnSync(compiler, ['--version']).error === undefined && headers !== null;
/** Where Debian has headers that are generated when a library is built: `dds/features.h`. */
const dds = ['/usr/include', ...readdirSync('/usr/include').map((name) => join('/usr/include', name))].find(
  (folder) => existsSync(join(folder, 'dds', 'features.h')),
);
const WARNINGS = [
  '-Wall',
  '-Wextra',
  '-Wno-unused-parameter',
  '-Wconversion',
  '-Wno-sign-conversion',
  '-Werror',
];

describe.skipIf(!here)(`for arm64 (needs ${compiler})`, () => {
  const out = useFolder();

  it.skipIf(dds === undefined).each(['dds'])('%s (needs cyclonedds-dev)', (name) => compile(name, 'gnu11'));
  it.each(['shared-memory', 'gpio', 'systemd', 'udp-batch'])('%s', (name) => compile(name, 'c11'));

  function compile(name: string, standard: string): void {
    const folder = join(packages, name, 'native');
    const sources = readdirSync(folder).filter((file) => file.endsWith('.c'));
    expect(sources).not.toEqual([]);
    for (const source of sources) {
      const { status, stderr } = spawnSync(
        compiler,
        [
          ...['-c', `-std=${standard}`, '-O3', '-fPIC', ...WARNINGS, '-DNAPI_VERSION=8', '-D_GNU_SOURCE'],
          `-I${INCLUDE_FOLDER}`,
          // After its own headers: DDS's headers are the same for every machine.
          ...[
            '-DDDS_NDEBUG',
            `-I${headers}/include/node`,
            '-idirafter',
            '/usr/include',
            '-idirafter',
            dds ?? '',
          ],
          ...[join(folder, source), '-o', join(out, `${name}-${source}.o`)],
        ],
        { encoding: 'utf8' },
      );
      expect({ source, status, stderr }).toEqual({ source, status: 0, stderr: '' });
    }
  }
});
