import {
  chmodSync,
  mkdirSync,
  renameSync,
  statSync,
  symlinkSync,
  truncateSync,
  writeFileSync,
} from 'node:fs';
import { join } from 'node:path';
import { beforeEach, describe, expect, it } from 'vitest';
import { MappedFile } from './mapped-file.ts';
import { ADDON_SUITE, codeOf, errorOf, scratchFolder } from './testing/helpers.ts';

let folder: string;
let path: string;
beforeEach(() => {
  folder = scratchFolder();
  path = join(folder, 'file');
});

const room = (pixels: number) => ({ depth: new Float32Array(pixels), colour: new Uint32Array(pixels) });

describe.skipIf(ADDON_SUITE.skip)(`mapped file (${ADDON_SUITE.note})`, () => {
  it('is shared by all processes that map it', () => {
    using writer = MappedFile.open(path, { bytes: 100, create: true });
    using reader = MappedFile.open(path, { bytes: 100 });
    writer.copyIn(3, Uint8Array.of(1, 2, 3));
    writer.store32(96, 0xdeadbeef);
    writer.store8(0, 255);
    const bytes = new Uint8Array(4);
    reader.copyOut(2, bytes);
    expect([...bytes]).toEqual([0, 1, 2, 3]);
    expect(reader.load32(96)).toBe(0xdeadbeef);
    expect(reader.load8(0)).toBe(255);
  });

  it('is created for its owner alone or for a group, never for everybody, whatever the umask', () => {
    const before = process.umask();
    const cases: [umask: number, asked: { mode?: number }, mode: number][] = [
      [0, {}, 0o600],
      [0, { mode: 0o660 }, 0o660],
      [0, { mode: 0o666 }, 0o660],
      [0o077, { mode: 0o660 }, 0o660],
    ];
    try {
      for (const [n, [umask, asked, mode]] of cases.entries()) {
        process.umask(umask);
        MappedFile.open(`${path}${n}`, { bytes: 1, create: true, ...asked }).close();
        expect(statSync(`${path}${n}`).mode & 0o777).toBe(mode);
      }
    } finally {
      process.umask(before);
    }
  });

  it.each<[string, (path: string) => void, string]>([
    ['nothing', () => undefined, 'absent'],
    ['a folder', (path) => mkdirSync(path), 'not-a-file'],
    [
      'a symbolic link',
      (path) => {
        writeFileSync(`${path}-real`, 'x');
        symlinkSync(`${path}-real`, path);
      },
      'not-a-file',
    ],
    ['an empty file', (path) => writeFileSync(path, ''), 'wrong-size'],
    ['a file of another size', (path) => writeFileSync(path, 'x'.repeat(11)), 'wrong-size'],
    [
      'a file that everybody may write',
      (path) => {
        writeFileSync(path, 'x'.repeat(10));
        chmodSync(path, 0o666);
      },
      'unsafe-permissions',
    ],
  ])('refuses %s', (_, make, code) => {
    make(path);
    const error = errorOf(() => MappedFile.open(path, { bytes: 10 }));
    expect(error.code).toBe(code);
    expect(error.file).toBe(path);
    expect(error.message).toContain(path);
  });

  it('survives truncation of the file, and names the byte', () => {
    using file = MappedFile.open(path, { bytes: 20_000, create: true });
    truncateSync(path, 5000);
    const bytes = new Uint8Array(20_000);
    for (const access of [
      () => file.load8(16_384),
      () => file.load32(16_384),
      () => file.store8(16_384, 1),
      () => file.store32(16_384, 1),
      () => file.copyIn(16_384, bytes.subarray(0, 100)),
      () => file.unpackPoints64(16_384, 1200, new Uint32Array(600)),
      () => file.images('depth32', { depth: 16_384, colour: 16_384, pixels: 9, unit: 0 }, room(9)),
    ]) {
      expect(errorOf(access)).toMatchObject({ code: 'truncated', file: path, offset: 16_384 });
    }
    // The first byte read is whichever memcpy touches first within the missing pages.
    const error = errorOf(() => file.copyOut(0, bytes));
    expect(error.code).toBe('truncated');
    expect(error.offset).toBeGreaterThanOrEqual(8192);
    expect(file.current).toBe(false);
    truncateSync(path, 20_000);
    expect(file.current).toBe(true);
    expect(file.load32(16_384)).toBe(0);
  });

  it('notices that another file has replaced it', () => {
    using file = MappedFile.open(path, { bytes: 10, create: true });
    expect(file.current).toBe(true);
    writeFileSync(`${path}2`, 'x'.repeat(10));
    renameSync(`${path}2`, path);
    expect(file.current).toBe(false);
    expect(file.load8(0)).toBe(0);
  });

  it('can be locked only once', () => {
    using first = MappedFile.open(path, { bytes: 10, create: true });
    expect(first.lock()).toBe(true);
    {
      using second = MappedFile.open(path);
      expect(second.lock()).toBe(false);
    }
    first.close();
    using third = MappedFile.open(path);
    expect(third.lock()).toBe(true);
  });

  it('refuses unaligned access, access beyond its end or once closed, and writes to a read-only mapping', () => {
    MappedFile.open(path, { bytes: 10, create: true }).close();
    const file = MappedFile.open(path);
    const bytes = new Uint8Array(11);
    for (const access of [
      () => file.load8(10),
      () => file.load8(-1),
      () => file.load8(Number.NaN),
      () => file.load32(8),
      () => file.load32(2),
      () => file.copyOut(0, bytes),
      () => file.copyOut(2 ** 53, bytes.subarray(1)),
      () => file.unpackPoints64(0, 8, new Uint32Array(3)),
      () => file.unpackPoints64(0, 7, new Uint32Array(400)),
      () => file.images('depth32', { depth: 0, colour: 0, pixels: 2 ** 52, unit: 0 }, room(4)),
      () => file.images('points', { depth: 0, colour: 0, pixels: 1, unit: 0 }, room(4)),
      () => file.store8(0, 1),
      () => file.copyIn(0, bytes.subarray(1)),
    ]) {
      expect(access).toThrow();
    }
    expect(codeOf(() => MappedFile.open(join(path, 'below')))).toBe('absent');
    file.close();
    expect(() => file.load8(0)).toThrow('it was closed');
    expect(() => file.close()).not.toThrow();
  });
});
