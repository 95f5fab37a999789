import { existsSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { folderFault, makeFolder } from './make-folder.ts';
import { useFolder } from './testing/folder.ts';

const folder = useFolder();
const file = join(folder, 'file');
writeFileSync(file, '');

it('makes what is missing, and leaves what is there', () => {
  const path = join(folder, 'a', 'b', 'c');
  expect(folderFault(path)).toBeNull();
  makeFolder(path, 0o750);
  makeFolder(path, 0o700);
  expect(statSync(path).mode & 0o777).toBe(0o750 & ~process.umask());
  const link = join(folder, 'link');
  symlinkSync(path, link);
  makeFolder(join(link, 'd'), 0o750);
  expect(existsSync(join(path, 'd'))).toBe(true);
  expect(folderFault(link)).toBeNull();
});

describe('where there can be no folder', () => {
  it.each([
    ['a file', file, 'is a file, not a folder'],
    ['below a file', join(file, 'a', 'b'), `is below a file: ${file}`],
    ['below a device', '/dev/null/state', 'is below a file: /dev/null'],
  ])('%s', (_, path, fault) => {
    expect(folderFault(path)).toBe(fault);
    expect(() => makeFolder(path, 0o750)).toThrow(/EEXIST|ENOTDIR/);
  });

  // Where the kernel makes up a file system, asking for a folder in it comes to an end, too.
  it.skipIf(!existsSync('/proc/self'))('in /proc', () => {
    expect(folderFault('/proc/farpoint/state')).toBe('is in /proc, which keeps no files');
    expect(() => makeFolder('/proc/farpoint/state', 0o750)).toThrow();
  });
});
