/**
 * `pnpm build:wasm [--check] [--out-of-tree DIR] [NAME…]`: builds the WASM modules that are committed beside their
 * users: all of them, or those named (`farpoint_codec`).
 *
 *     --check            only compares each module's recorded hash with its sources (needs no Rust)
 *     --out-of-tree DIR  writes DIR/<name>/ and leaves the committed files alone
 */
import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { homedir, tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { hashSources, sourcesOf } from './wasm-sources.ts';
import { CARGO_WORKSPACE, WASM_CRATES, type WasmCrate } from './wasm-table.ts';
import {
  findWasmToolchain,
  NoWasmToolchainError,
  WASM_TARGET,
  type WasmToolchain,
} from './wasm-toolchain.ts';

export { findWasmToolchain, NoWasmToolchainError } from './wasm-toolchain.ts';

const ROOT = resolve(import.meta.dirname, '..');
const require = createRequire(import.meta.url);
const RECORD = 'sources.json';

/** Stored with every committed module. */
export interface WasmRecord {
  /** SHA-256 over the sources (see wasm-sources.ts). */
  sources: string;
  /** Compiler, wasm-bindgen and wasm-opt. With the same versions, the same sources give the same bytes. */
  toolchain: string;
  /** SHA-256 of `<name>_bg.wasm`. */
  wasm: string;
}

/** A committed module that does not match its sources or its record. */
export interface StaleModule {
  name: string;
  outDir: string;
  reason: 'missing' | 'sources-changed' | 'module-changed';
}

/** The stale ones among the committed modules. Needs no Rust. */
export function checkFresh(root: string = ROOT, crates: readonly WasmCrate[] = WASM_CRATES): StaleModule[] {
  const stale: StaleModule[] = [];
  for (const crate of crates) {
    const folder = join(root, crate.outDir);
    const record = readRecord(folder);
    const module = join(folder, `${crate.name}_bg.wasm`);
    let reason: StaleModule['reason'] | null = null;
    if (record === null || !existsSync(module)) reason = 'missing';
    else if (record.sources !== hashSources(sourcesOf(root, crate))) reason = 'sources-changed';
    else if (record.wasm !== sha256(readFileSync(module))) reason = 'module-changed';
    if (reason !== null) stale.push({ name: crate.name, outDir: crate.outDir, reason });
  }
  return stale;
}

export interface BuildOptions {
  /** Writes `<outOfTree>/<name>/` instead of the committed folders. */
  outOfTree?: string;
  /** Default: all crates of the table. */
  crates?: readonly WasmCrate[];
  toolchain?: WasmToolchain;
  log?: (line: string) => void;
}

/** A built module: its location and its record. */
export interface BuiltModule {
  crate: WasmCrate;
  folder: string;
  record: WasmRecord;
}

/**
 * Builds every module of the table.
 *
 * @throws NoWasmToolchainError, or an Error naming the step that failed
 */
export function buildWasm(options: BuildOptions = {}): BuiltModule[] {
  const log = options.log ?? (() => {});
  const toolchain = options.toolchain ?? findWasmToolchain({ log });
  const workspace = join(ROOT, CARGO_WORKSPACE);
  log(`toolchain: ${toolchain.version} (${toolchain.kind})`);

  const crates = options.crates ?? WASM_CRATES;
  // Always all crates: crates compiled together share features, and other features would give other bytes.
  const packages = WASM_CRATES.flatMap((crate) => ['-p', crate.package]);
  // A separate folder: after another compiler, Cargo would rebuild everything each time.
  const target = join(workspace, 'target', 'wasm');
  // A check must not change the lock file. A developer's build may do so after a change of dependencies.
  const locked = options.outOfTree === undefined ? [] : ['--locked'];
  log(`compiling ${crates.map((crate) => crate.package).join(', ')}`);
  run(
    toolchain.cargo,
    ['build', '--release', ...locked, '--target', WASM_TARGET, ...toolchain.cargoArgs, ...packages],
    workspace,
    { ...toolchain.env, CARGO_TARGET_DIR: target, CARGO_ENCODED_RUSTFLAGS: rustFlags(toolchain, workspace) },
  );
  log('compiling xtask (wasm-bindgen)');
  const xtaskEnv = toolchain.kind === 'debian' && !hasRustc() ? { RUSTC: '/usr/bin/rustc' } : {};
  run(toolchain.cargo, ['build', ...locked, '-p', 'xtask'], workspace, xtaskEnv);

  const versions = `${toolchain.version}; ${toolVersions(workspace)}`;
  return crates.map((crate) => {
    const scratch = mkdtempSync(join(tmpdir(), 'farpoint-wasm-'));
    try {
      const compiled = join(target, WASM_TARGET, 'release', `${crate.name}.wasm`);
      run(join(workspace, 'target', 'debug', 'xtask'), ['bindgen', compiled, scratch, crate.name], workspace);
      const module = join(scratch, `${crate.name}_bg.wasm`);
      optimise(module);
      const record: WasmRecord = {
        sources: hashSources(sourcesOf(ROOT, crate)),
        toolchain: versions,
        wasm: sha256(readFileSync(module)),
      };
      writeFileSync(join(scratch, RECORD), `${JSON.stringify(record, null, 2)}\n`);
      const folder = options.outOfTree ? join(options.outOfTree, crate.name) : join(ROOT, crate.outDir);
      mkdirSync(folder, { recursive: true });
      cpSync(scratch, folder, { recursive: true });
      const kilobytes = (readFileSync(join(folder, `${crate.name}_bg.wasm`)).length / 1024).toFixed(1);
      log(`${folder}: ${crate.name}_bg.wasm, ${kilobytes} KiB`);
      return { crate, folder, record };
    } finally {
      rmSync(scratch, { recursive: true, force: true });
    }
  });
}

/** The record stored with a module; null if there is no readable one. */
export function readRecord(folder: string): WasmRecord | null {
  try {
    const value: unknown = JSON.parse(readFileSync(join(folder, RECORD), 'utf8'));
    if (typeof value !== 'object' || value === null) return null;
    const { sources, toolchain, wasm } = value as Record<string, unknown>;
    if (typeof sources !== 'string' || typeof toolchain !== 'string' || typeof wasm !== 'string') return null;
    return { sources, toolchain, wasm };
  } catch {
    return null;
  }
}

/** Enables SIMD, and removes this machine's paths, so that the module has the same bytes wherever it is built. */
function rustFlags(toolchain: WasmToolchain, workspace: string): string {
  const cargoHome = process.env.CARGO_HOME ?? join(homedir(), '.cargo');
  const flags = [
    '-Ctarget-feature=+simd128',
    ...toolchain.rustFlags,
    `--remap-path-prefix=${cargoHome}=/cargo`,
    `--remap-path-prefix=${toolchain.sysroot}=/rust`,
    `--remap-path-prefix=${workspace}=/farpoint`,
  ];
  return flags.join('\x1f');
}

function optimise(module: string): void {
  const tool = join(require.resolve('binaryen/package.json'), '..', 'bin', 'wasm-opt');
  const features = ['simd', 'bulk-memory', 'nontrapping-float-to-int', 'sign-ext', 'mutable-globals'];
  const enabled = [...features, 'reference-types', 'multivalue'].map((feature) => `--enable-${feature}`);
  // More optimisation makes the codec 5 % slower, because LLVM has already laid out hot code well.
  run(
    process.execPath,
    [tool, '-O1', '--strip-debug', '--strip-producers', ...enabled, module, '-o', module],
    ROOT,
  );
}

function toolVersions(workspace: string): string {
  const lock = readFileSync(join(workspace, 'Cargo.lock'), 'utf8');
  const bindgen = /name = "wasm-bindgen"\nversion = "([^"]+)"/.exec(lock)?.[1] ?? 'unknown';
  const binaryen = (require('binaryen/package.json') as { version: string }).version;
  return `wasm-bindgen ${bindgen}; binaryen ${binaryen}`;
}

function hasRustc(): boolean {
  return spawnSync('rustc', ['--version'], { stdio: 'ignore' }).status === 0;
}

function run(command: string, args: string[], cwd: string, env: Record<string, string> = {}): void {
  // Cargo writes its progress to standard error.
  const stdio: ['ignore', 'ignore', 'inherit'] = ['ignore', 'ignore', 'inherit'];
  const result = spawnSync(command, args, { cwd, stdio, env: { ...process.env, ...env } });
  if (result.error !== undefined) throw new Error(`${command}: ${result.error.message}`);
  if (result.status !== 0)
    throw new Error(`${command} ${args.slice(0, 2).join(' ')} failed (${result.status})`);
}

function sha256(bytes: Uint8Array): string {
  return createHash('sha256').update(bytes).digest('hex');
}

function main(): number {
  const { values, positionals } = parseArgs({
    options: { check: { type: 'boolean' }, 'out-of-tree': { type: 'string' }, help: { type: 'boolean' } },
    allowPositionals: true,
  });
  if (values.help) {
    console.log('pnpm build:wasm [--check] [--out-of-tree DIR] [NAME…]');
    return 0;
  }
  const known = WASM_CRATES.map((crate) => crate.name);
  const unknown = positionals.find((name) => !known.includes(name));
  if (unknown !== undefined) {
    console.error(`build:wasm: there is no module \`${unknown}\`; the modules are ${known.join(', ')}`);
    return 2;
  }
  const crates = WASM_CRATES.filter(({ name }) => positionals.length === 0 || positionals.includes(name));
  if (values.check) {
    const stale = checkFresh(ROOT, crates);
    for (const { name, outDir, reason } of stale) {
      console.error(
        `${outDir}: ${name} is not built from the present sources (${reason}): run \`pnpm build:wasm\``,
      );
    }
    if (stale.length === 0) console.log('WASM modules match their sources');
    return stale.length === 0 ? 0 : 1;
  }
  try {
    const outOfTree = values['out-of-tree'];
    const elsewhere = outOfTree === undefined ? {} : { outOfTree: resolve(outOfTree) };
    buildWasm({ crates, log: (line) => console.error(line), ...elsewhere });
    return 0;
  } catch (error) {
    if (!(error instanceof Error)) throw error;
    console.error(error instanceof NoWasmToolchainError ? error.message : `build:wasm: ${error.message}`);
    return 1;
  }
}

if (import.meta.main) process.exitCode = main();
