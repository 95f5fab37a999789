/**
 * Checks the structure of the Rust sources: no cycles of files within a crate, and no file that is too long to read
 * in one go.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { cycles } from './lib/cycles.ts';
import { root } from './lib/run.ts';
import { rustFileGraph } from './lib/rust-modules.ts';
import { CARGO_WORKSPACE } from './wasm-table.ts';

const MAX_LINES = 300;
/** Generated files. */
const GENERATED = ['crates/unorganised-codec/src/tables_data.rs'];

const workspace = join(root, CARGO_WORKSPACE);
const files = readdirSync(workspace, { recursive: true, encoding: 'utf8' })
  .map((file) => file.replaceAll('\\', '/'))
  .filter((file) => file.endsWith('.rs') && !/(^|\/)(target|node_modules)\//.test(file))
  .sort();
const read = (file: string) => readFileSync(join(workspace, file), 'utf8');

/** Folders with a `lib.rs` or `main.rs`: libraries, programs, and examples with several files. */
const crates = files.flatMap((file) => /^(.*)\/(?:lib|main)\.rs$/.exec(file)?.[1] ?? []);

test('there are crates to check', () => {
  expect(crates).toContain('crates/organised-codec/src');
  expect(crates).toContain('xtask/src');
});

describe('no file of a crate uses itself through others', () => {
  test.each(crates)('%s', (crate) => {
    const own = files.filter((file) => file.startsWith(`${crate}/`));
    const sources = new Map(own.map((file) => [file.slice(crate.length + 1), read(file)]));
    const graph = rustFileGraph(sources);
    const found = cycles(graph).map((group) =>
      group.map((file) => {
        const targets = [...(graph.get(file) ?? [])].filter((target) => group.includes(target));
        return `${file} uses ${targets.join(', ')}`;
      }),
    );
    expect(found).toEqual([]);
  });
});

test(`no Rust source has more than ${MAX_LINES} lines, except generated ones`, () => {
  const lengths = files
    .filter((file) => !GENERATED.includes(file))
    .map((file) => [file, lines(read(file))] as const);
  expect(lengths.filter(([, length]) => length > MAX_LINES)).toEqual([]);
  expect(files).toEqual(expect.arrayContaining(GENERATED));
});

function lines(text: string): number {
  return text.split('\n').length - (text.endsWith('\n') ? 1 : 0);
}
