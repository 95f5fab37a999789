import { existsSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { expect, test, vi } from 'vitest';
import { processFolder } from './process-folder.ts';

test('the folders of a process go with it, with their files', () => {
  const once = vi.spyOn(process, 'once').mockReturnThis();
  const parent = processFolder();
  const folders = [parent, processFolder(parent)];
  for (const folder of folders) writeFileSync(join(folder, 'file'), '');
  expect(folders.map((folder) => dirname(folder))).toEqual([tmpdir(), parent]);

  const ends = once.mock.calls.filter(([event]) => event === 'exit');
  expect(ends).toHaveLength(1);
  for (const [, end] of ends) end();
  expect(folders.filter((folder) => existsSync(folder))).toEqual([]);
});
