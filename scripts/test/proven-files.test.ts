import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, it } from 'vitest';
import { ProvenFiles } from './proven-files.ts';

const folder = useFolder();

it('remembers what has passed, and forgets the oldest', () => {
  const file = join(folder, 'new', 'files.json');
  const proven = new ProvenFiles(file);
  proven.keep(Array.from({ length: 20_001 }, (_, n) => `hash ${n}`));
  const again = new ProvenFiles(file);
  expect([again.has('hash 0'), again.has('hash 1'), again.has('hash 20000')]).toEqual([false, true, true]);
});

it('a damaged file proves nothing', () => {
  const file = join(folder, 'damaged.json');
  writeFileSync(file, '{"a": 1');
  expect(new ProvenFiles(file).has('a')).toBe(false);
});
