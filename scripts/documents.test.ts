/**
 * Tests every command in README and documents as far as that needs no program: each is known, its files and its script
 * exist, and its options are in the sources. What needs one: documents.stack.test.ts, document-commands-run.stack.test.ts.
 */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { TREATMENTS } from './lib/document-command-table.ts';
import { shellWords } from './lib/document-commands.ts';
import {
  benchOf,
  found,
  known,
  names,
  optionsIn,
  programOf,
  read,
  scriptOf,
  scripts,
  texts,
} from './lib/document-programs.ts';
import { importedFiles } from './lib/file-imports.ts';
import { root } from './lib/run.ts';

test('each command is in the table, and each in the table is in a document', () => {
  const unknown = found.filter(({ text }) => TREATMENTS[text] === undefined);
  expect(unknown.map(({ file, line, text }) => `${file}:${line}: ${text}`)).toEqual([]);
  expect(Object.keys(TREATMENTS).filter((text) => !texts.includes(text))).toEqual([]);
});

test('programs are started through their scripts, so that Node 18 or newer is enough', () => {
  const direct = found.filter(({ text }) => /\bnode (apps|packages|tools|scripts|bench)\/\S+\.ts/.test(text));
  const allowed = direct.filter(({ text }) => text.includes('pnpm@12 exec node '));
  expect(direct.map(({ text }) => text)).toEqual(allowed.map(({ text }) => text));
});

describe('files and scripts that commands name exist', () => {
  test.each(known)('$text', ({ text }) => {
    const words = shellWords(text);
    for (const word of words) {
      if (
        /^(apps|docs|examples|packages|scripts|tools|wasm-codec)\/\S+$/.test(word) &&
        !word.includes('/dist')
      )
        expect(existsSync(join(root, word)), word).toBe(true);
    }
    const script = scriptOf(words);
    if (script !== null) expect(Object.keys(scripts)).toContain(script.name);
  });
});

describe('a command’s options are in the file', () => {
  const inFiles = known.flatMap(({ text, treatment }) =>
    'options' in treatment ? [{ text, file: treatment.options }] : [],
  );
  test.each(inFiles)('$text', ({ text, file }) => {
    const words = shellWords(text);
    for (const option of optionsIn(words.slice(words.indexOf(file) + 1)))
      expect(names(read(file), option), `${option} in ${file}`).toBe(true);
  });
});

describe('a benchmark’s options are in its sources', () => {
  const benches = known.flatMap(({ text, treatment }) => {
    const file = 'help' in treatment ? benchOf(programOf(shellWords(text))) : null;
    return file === null ? [] : [{ text, file }];
  });
  test.each(benches)('$text', ({ text, file }) => {
    expect(read(file)).toMatch(/^export const bench\b/m);
    const sources = [...withImports(file)].map(read);
    for (const option of optionsIn(programOf(shellWords(text)).args))
      expect(
        sources.some((source) => names(source, option)),
        `${option} of ${file}`,
      ).toBe(true);
  });
});

/** The file, and those of the benchmarks that it uses. */
function withImports(file: string, all = new Set<string>()): Set<string> {
  if (all.has(file) || !file.startsWith('bench/')) return all;
  all.add(file);
  for (const imported of importedFiles(file, read(file))) withImports(imported, all);
  return all;
}
