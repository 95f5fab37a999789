import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, it } from 'vitest';
import { ProvenFiles } from './proven-files.ts';

const folder = useFolder();

it('remembers what has passed and what it took, and forgets the oldest', () => {
  const file = join(folder, 'new', 'files.json');
  const proven = new ProvenFiles(file);
  const names = (word: string) => Array.from({ length: 20_001 }, (_, n) => `${word} ${n}`);
  proven.keep({
    tests: names('test'),
    inputs: names('input'),
    ms: Object.fromEntries(names('file').map((name, n) => [name, n])),
  });
  const again = new ProvenFiles(file);
  expect([0, 1, 20_000].map((n) => again.has(`test ${n}`))).toEqual([false, true, true]);
  expect([0, 1, 20_000].map((n) => again.hasInput(`input ${n}`))).toEqual([false, true, true]);
  expect([0, 1, 20_000].map((n) => again.msOf(`file ${n}`))).toEqual([undefined, 1, 20_000]);
});

it('a damaged file proves nothing', () => {
  const file = join(folder, 'damaged.json');
  writeFileSync(file, '{"a": 1');
  expect(new ProvenFiles(file).has('a')).toBe(false);
});
