import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { beforeEach, describe, expect, it } from 'vitest';
import { cacheFolder, ProvenGroups } from './proven.ts';

let folder: string;
beforeEach(() => {
  folder = testFolder();
});
const proof = (inputs: string, tools = 'gcc 12') => ({ inputs, tools, at: '2026-11-28T00:00:00.000Z' });

describe('what has passed', () => {
  it('is known to the next run, by inputs and tools', () => {
    const file = join(folder, 'new', 'passed.json');
    new ProvenGroups(file).keep('video', proof('a'));
    const next = new ProvenGroups(file);
    expect(next.proof('video', 'a', 'gcc 12')).toEqual(proof('a'));
    expect(next.proof('video', 'b', 'gcc 12')).toBeUndefined();
    expect(next.proof('video', 'a', 'gcc 13')).toBeUndefined();
    expect(next.proof('sound', 'a', 'gcc 12')).toBeUndefined();
  });

  it('tells whether what a group tests has changed since it passed, whatever the tools', () => {
    const proven = new ProvenGroups(join(folder, 'passed.json'));
    expect(proven.hasChanged('video', 'a')).toBe(false);
    proven.keep('video', proof('a'));
    expect([proven.hasChanged('video', 'a'), proven.hasChanged('video', 'b')]).toEqual([false, true]);
  });

  it('is kept for several checkouts, but not for ever', () => {
    const proven = new ProvenGroups(join(folder, 'passed.json'));
    for (let n = 0; n < 13; n++) proven.keep('video', proof(`${n}`));
    expect(proven.proof('video', '0', 'gcc 12')).toBeUndefined();
    expect(proven.proof('video', '1', 'gcc 12')).toBeDefined();
  });

  it.each(['', '{', '{"video":[{"inputs":1}]}', '[]'])('is nothing if the file is %j', (text) => {
    const file = join(folder, 'passed.json');
    writeFileSync(file, text);
    expect(new ProvenGroups(file).proof('video', 'a', 'gcc 12')).toBeUndefined();
  });
});

it('is kept in the user’s folder for caches', () => {
  expect(cacheFolder({ FARPOINT_CACHE: '/a' }, 'linux')).toBe('/a');
  expect(cacheFolder({ XDG_CACHE_HOME: '/x' }, 'linux')).toBe(join('/x', 'farpoint'));
  expect(cacheFolder({}, 'linux')).toMatch(/\.cache.farpoint$/);
  expect(cacheFolder({}, 'darwin')).toMatch(/Library.Caches.farpoint$/);
});
