import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import fc from 'fast-check';
import { beforeEach, describe, expect, test } from 'vitest';
import { checkFresh } from './build-wasm.ts';
import { hashSources, type SourceFile, sourcesOf } from './wasm-sources.ts';
import { WASM_CRATES } from './wasm-table.ts';

const file = (path: string, text: string): SourceFile => ({ path, bytes: Buffer.from(text) });

describe('hashSources', () => {
  const files = [file('a.rs', 'fn a() {}\n'), file('b.rs', 'fn b() {}\n')];

  test('does not depend on the order of the files or on their line endings', () => {
    expect(hashSources([...files].reverse())).toBe(hashSources(files));
    const windows = files.map(({ path, bytes }) =>
      file(path, Buffer.from(bytes).toString().replaceAll('\n', '\r\n')),
    );
    expect(hashSources(windows)).toBe(hashSources(files));
  });

  test('differs for any other set of files', () => {
    const anyFiles = fc.uniqueArray(
      fc.record({ path: fc.stringMatching(/^[ab/]{1,3}$/), text: fc.stringMatching(/^[a\n1]{0,4}$/) }),
      { selector: (one) => one.path, maxLength: 3 },
    );
    const plain = (set: { path: string; text: string }[]) =>
      JSON.stringify(set.map(({ path, text }) => [path, text]).sort());
    fc.assert(
      fc.property(anyFiles, anyFiles, (one, other) => {
        const hash = (set: typeof one) => hashSources(set.map(({ path, text }) => file(path, text)));
        expect(hash(one) === hash(other)).toBe(plain(one) === plain(other));
      }),
      { seed: 1, numRuns: 500 },
    );
  });
});

describe('checkFresh', () => {
  const repository = resolve(import.meta.dirname, '..');
  const [crate] = WASM_CRATES;
  if (crate === undefined) throw new Error('the table is empty');
  let root = '';

  beforeEach(() => {
    root = testFolder();
    for (const { path, bytes } of sourcesOf(repository, crate)) {
      mkdirSync(join(root, 'wasm-codec', path, '..'), { recursive: true });
      writeFileSync(join(root, 'wasm-codec', path), bytes);
    }
    const folder = join(root, crate.outDir);
    cpSync(join(repository, crate.outDir), folder, { recursive: true });
    // Valid whatever state the checkout's own module is in.
    const record = JSON.parse(readFileSync(join(folder, 'sources.json'), 'utf8')) as Record<string, string>;
    record.sources = hashSources(sourcesOf(root, crate));
    writeFileSync(join(folder, 'sources.json'), JSON.stringify(record));
  });

  test('accepts a module that was built from its sources', () => {
    expect(checkFresh(root, [crate])).toEqual([]);
  });

  test('notices a changed source, a changed module and a missing one', () => {
    const reasons = () => checkFresh(root, [crate]).map(({ reason }) => reason);
    const source = join(root, 'wasm-codec/crates', crate.crates[0] ?? '', 'src/lib.rs');
    const before = readFileSync(source, 'utf8');
    writeFileSync(source, `${before}// changed\n`);
    expect(reasons()).toEqual(['sources-changed']);
    writeFileSync(source, before);

    const tests = join(root, 'wasm-codec/crates', crate.crates[0] ?? '', 'tests');
    mkdirSync(tests, { recursive: true });
    writeFileSync(join(tests, 'another.rs'), '// tests are not in the module\n');
    expect(reasons()).toEqual([]);

    writeFileSync(join(root, crate.outDir, `${crate.name}_bg.wasm`), 'not this');
    expect(reasons()).toEqual(['module-changed']);
    rmSync(join(root, crate.outDir), { recursive: true });
    expect(reasons()).toEqual(['missing']);
  });
});
