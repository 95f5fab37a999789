import { mkdirSync, renameSync, rmSync, truncateSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { testFolder } from './testing/folder.ts';
import { WatchedText } from './watched-text.ts';

let folder: string;
let path: string;
let told: string[];
let watched: WatchedText;
beforeEach(() => {
  folder = testFolder();
  path = join(folder, 'list');
  told = [];
  watched = new WatchedText({
    ...{ path, maxBytes: 20, intervalMs: 1 },
    onText: (text) => {
      if (text.includes('half')) throw new Error('not whole');
      told.push(text);
    },
    onFault: (detail) => told.push(`fault: ${detail.replace(path, 'list')}`),
  });
});
afterEach(() => {
  watched.close();
});

/** What it told, after the file was read again. */
async function checked(): Promise<string[]> {
  await watched.check();
  return told.splice(0);
}

it('tells the content first and at each change, in place or by another file', async () => {
  writeFileSync(path, 'a');
  expect(await checked()).toEqual(['a']);
  expect(await checked()).toEqual([]);
  writeFileSync(path, 'b');
  expect(await checked()).toEqual(['b']);
  writeFileSync(`${path}.new`, 'c');
  renameSync(`${path}.new`, path);
  expect(await checked()).toEqual(['c']);
});

it('tells each fault once, and goes on', async () => {
  expect(await checked()).toEqual(['fault: list does not exist']);
  expect(await checked()).toEqual([]);
  writeFileSync(path, 'half');
  expect(await checked()).toEqual(['fault: list: not whole']);
  expect(await checked()).toEqual([]);
  writeFileSync(path, 'half and whole');
  expect(await checked()).toEqual(['fault: list: not whole']);
  writeFileSync(path, 'whole');
  expect(await checked()).toEqual(['whole']);
  rmSync(path);
  expect(await checked()).toEqual(['fault: list does not exist']);
  writeFileSync(path, 'whole');
  expect(await checked()).toEqual([]);
  rmSync(path);
  expect(await checked()).toEqual(['fault: list does not exist']);
});

it('reads neither what is too long nor what is no file', async () => {
  writeFileSync(path, '');
  truncateSync(path, 21);
  expect(await checked()).toEqual(['fault: list is longer than 20 bytes']);
  rmSync(path);
  mkdirSync(path);
  expect(await checked()).toEqual(['fault: list is not a regular file']);
});

it('reads again and again until it is closed', async () => {
  writeFileSync(path, 'a');
  const changed = new Promise<string>((resolve) => {
    const other = new WatchedText({
      ...{ path, maxBytes: 20, intervalMs: 1 },
      onText: (text) => {
        if (text !== 'b') return;
        other.close();
        resolve(text);
      },
      onFault: () => undefined,
    });
    void other.start().then(() => writeFileSync(path, 'b'));
  });
  expect(await changed).toBe('b');
});
