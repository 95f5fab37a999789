/**
 * The hash that ties a committed WASM module to its sources, so that a stale module is found without a Rust compiler.
 */
import { createHash } from 'node:crypto';
import { type Dirent, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { CARGO_WORKSPACE, type WasmCrate } from './wasm-table.ts';

/** A source file: its path from the workspace's root, with `/` between parts, and its bytes. */
export interface SourceFile {
  path: string;
  bytes: Uint8Array;
}

/** Folders inside a crate that do not affect the module. */
const LEFT_OUT = new Set(['target', 'tests', 'benches', 'examples', 'proptest-regressions']);

/** SHA-256 (hex) over the files in the order of their paths; line endings count as LF. */
export function hashSources(files: readonly SourceFile[]): string {
  const hash = createHash('sha256');
  const sorted = [...files].sort((a, b) => (a.path < b.path ? -1 : a.path > b.path ? 1 : 0));
  for (const file of sorted) {
    const text = Buffer.from(file.bytes).toString('utf8').replaceAll('\r\n', '\n');
    // Lengths precede contents, so that no two different sets of files give the same bytes.
    hash.update(`${file.path}\n${Buffer.byteLength(text)}\n`);
    hash.update(text);
  }
  return hash.digest('hex');
}

/** The files that a module is built from: its crates, the workspace's manifest and lock file, and xtask. */
export function sourcesOf(root: string, crate: WasmCrate): SourceFile[] {
  const workspace = join(root, CARGO_WORKSPACE);
  const files: SourceFile[] = [];
  const add = (path: string) => files.push({ path, bytes: readFileSync(join(workspace, path)) });
  const walk = (folder: string) => {
    for (const entry of entriesOf(join(workspace, folder))) {
      const path = `${folder}/${entry.name}`;
      if (entry.isDirectory() && !LEFT_OUT.has(entry.name)) walk(path);
      else if (entry.isFile() && (entry.name.endsWith('.rs') || entry.name === 'Cargo.toml')) add(path);
    }
  };
  add('Cargo.toml');
  add('Cargo.lock');
  walk('xtask');
  for (const name of crate.crates) walk(`crates/${name}`);
  return files;
}

function entriesOf(folder: string): Dirent[] {
  return readdirSync(folder, { withFileTypes: true });
}
