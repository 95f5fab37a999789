import { expect, test } from 'vitest';
import { holderIn } from './lock-holder.ts';

const TABLE = `1: POSIX  ADVISORY  WRITE 11 08:01:77 0 EOF
2: FLOCK  ADVISORY  WRITE 22 00:1a:77 0 EOF
2: -> FLOCK  ADVISORY  WRITE 23 00:1a:78 0 EOF
3: FLOCK  ADVISORY  WRITE 33 08:01:77 0 EOF
4: FLOCK  ADVISORY  WRITE 0 103:105:9 0 EOF
5: FLOCK  ADVISORY  WRITE 55 103:105:10 0 EOF
`;
const device = (major: number, minor: number) => (major << 8) | (minor & 0xff) | ((minor & ~0xff) << 12);

test.each([
  [device(0, 0x1a), 77, 22],
  [device(8, 1), 77, 33],
  [device(0x103, 0x105), 10, 55],
  // It waits, and holds nothing.
  [device(0, 0x1a), 78, null],
  // In another container.
  [device(0x103, 0x105), 9, null],
  [device(8, 2), 77, null],
])('device %i, inode %i: process %j', (dev, ino, pid) => {
  expect(holderIn(TABLE, { dev, ino })).toBe(pid);
});

test('nonsense holds nothing', () => {
  expect(holderIn('\n:::\nFLOCK', { dev: 1, ino: 1 })).toBeNull();
});
