import { writeFileSync } from 'node:fs';
import { devNull } from 'node:os';
import { join } from 'node:path';
import { expect, it } from 'vitest';
import { OptionsError } from './option-errors.ts';
import { defineProgram } from './option-table.ts';
import { resolveOptions } from './options.ts';
import { uselessFiles } from './testing/useless-files.ts';
import { readTextFile, TextFileError } from './text-file.ts';

const useless = uselessFiles();
const folder = join(useless[0]?.path ?? '', '..');

function fault(run: () => unknown): unknown {
  try {
    run();
  } catch (error) {
    return error;
  }
  throw new Error('nothing is wrong');
}

it.each(useless)('a file that is $what is refused with its path: $words', ({ path, words }) => {
  const error = fault(() => readTextFile(path)) as TextFileError;
  expect(error).toBeInstanceOf(TextFileError);
  expect(error.path).toBe(path);
  expect(error.message).toContain(path);
  expect(error.message).toContain(words);
});

it('tells a file that is not there from one that holds nothing', () => {
  const codes = useless.map(({ what, path }) => [
    what,
    (fault(() => readTextFile(path)) as TextFileError).code,
  ]);
  expect(Object.fromEntries(codes)).toMatchObject({ missing: 'ENOENT', empty: null, 'a folder': 'EISDIR' });
});

it('takes text without the byte order mark before it, and as it is otherwise', () => {
  const path = join(folder, 'marked');
  writeFileSync(path, '\uFEFF{"name": "Köln"}\n');
  expect(readTextFile(path)).toBe('{"name": "Köln"}\n');
});

const program = defineProgram({
  ...{ name: 'farpoint-robot', summary: '', version: '1', section: 'robot', options: {} },
});

it.each(useless)('a configuration file that is $what is refused', ({ path, words }) => {
  const error = fault(() => resolveOptions(program, { argv: ['--config', path], env: {} })) as OptionsError;
  expect(error).toBeInstanceOf(OptionsError);
  expect(error.message).toContain(path);
  expect(error.message).toContain(words.replace('does not exist', 'that does not exist'));
});

it('a configuration from /dev/null is none', () => {
  expect(resolveOptions(program, { argv: ['--config', devNull], env: {} }).action).toBe('run');
});
