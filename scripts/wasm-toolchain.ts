/** Finds a Rust compiler for `wasm32-unknown-unknown`, in the ways that work on ordinary machines. */
import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';
import { rootCommand } from './lib/run.ts';

export const WASM_TARGET = 'wasm32-unknown-unknown';

const DEBIAN_RUSTC = '/usr/bin/rustc';
/** Debian's newer compiler (packaged for browsers), the sources of its standard library, and its linker. */
const DEBIAN_PACKAGES = ['rustc-web', 'rust-web-src', 'rust-web-llvm', 'lld-22'];

export interface WasmToolchain {
  /** How it was found. */
  kind: 'rustup' | 'debian';
  /** `rustc --version`, in full. */
  version: string;
  /** The compiler's own files. Their paths must not appear in its output. */
  sysroot: string;
  /** The Cargo that drives it. */
  cargo: string;
  /** Environment variables for Cargo, in addition to the present ones. */
  env: Record<string, string>;
  /** Options for `cargo build`, after `--target`. */
  cargoArgs: string[];
  /** Compiler flags. */
  rustFlags: string[];
}

/** There is no toolchain. `message` is one sentence that says what is missing and which command fixes it. */
export class NoWasmToolchainError extends Error {
  override readonly name = 'NoWasmToolchainError';
}

export interface FindOptions {
  /** Whether missing parts may be installed (`rustup target add`, `apt-get install`). Default true. */
  install?: boolean;
  /** Called with a line about each installation. */
  log?: (line: string) => void;
}

/** @throws NoWasmToolchainError */
export function findWasmToolchain(options: FindOptions = {}): WasmToolchain {
  const install = options.install ?? true;
  const log = options.log ?? (() => {});
  const cargo = findCargo();

  if (cargo !== null) {
    const ready = rustupToolchain(cargo);
    if (ready !== null) return ready;
  }
  // Tried before rustup contacts its server: machines that cannot reach it may already have Debian's compiler.
  const debian = debianToolchain(cargo);
  if (debian !== null) return debian;

  if (install && cargo !== null && succeeds('rustup', ['--version'])) {
    log(`rustup target add ${WASM_TARGET}`);
    if (succeeds('rustup', ['target', 'add', WASM_TARGET], 60_000)) {
      const added = rustupToolchain(cargo);
      if (added !== null) return added;
    }
  }
  if (install && installDebianPackages(cargo === null, log)) {
    const installed = debianToolchain(findCargo());
    if (installed !== null) return installed;
  }
  throw new NoWasmToolchainError(cureFor(cargo));
}

function rustupToolchain(cargo: string): WasmToolchain | null {
  const libraries = output('rustc', ['--print', 'target-libdir', '--target', WASM_TARGET]);
  if (libraries === null || !existsSync(libraries)) return null;
  const version = output('rustc', ['--version']);
  const sysroot = output('rustc', ['--print', 'sysroot']);
  if (version === null || sysroot === null) return null;
  return { kind: 'rustup', version, sysroot, cargo, env: {}, cargoArgs: [], rustFlags: [] };
}

/** Debian has no WASM standard library for that version; Cargo builds it from Debian's sources. */
function debianToolchain(cargo: string | null): WasmToolchain | null {
  const linker = debianLinker();
  if (cargo === null || linker === null || !existsSync(DEBIAN_RUSTC)) return null;
  const version = output(DEBIAN_RUSTC, ['--version']);
  const sysroot = output(DEBIAN_RUSTC, ['--print', 'sysroot']);
  if (version === null || sysroot === null) return null;
  if (!existsSync(join(sysroot, 'lib/rustlib/src/rust/library/std/Cargo.toml'))) return null;
  return {
    kind: 'debian',
    version,
    sysroot,
    cargo,
    // A released compiler builds the standard library only with this explicit permission.
    env: { RUSTC: DEBIAN_RUSTC, RUSTC_BOOTSTRAP: '1' },
    cargoArgs: ['-Zbuild-std=std,panic_abort'],
    rustFlags: [`-Clinker=${linker}`],
  };
}

/** The linker of the newest installed LLVM. Debian keeps each version in its own folder. */
function debianLinker(): string | null {
  const versions = existsSync('/usr/lib') ? readdirSync('/usr/lib') : [];
  const linkers = versions
    .map((name) => /^llvm-(\d+)$/.exec(name)?.[1])
    .filter((version) => version !== undefined)
    .sort((a, b) => Number(b) - Number(a))
    .map((version) => `/usr/lib/llvm-${version}/bin/wasm-ld`);
  return linkers.find((linker) => existsSync(linker)) ?? null;
}

function installDebianPackages(withCargo: boolean, log: (line: string) => void): boolean {
  if (!isDebian()) return false;
  const asRoot = rootCommand();
  if (asRoot === null) return false;
  const packages = withCargo ? [...DEBIAN_PACKAGES, 'cargo-web'] : DEBIAN_PACKAGES;
  const apt = (args: string[]): boolean => {
    const command = [...asRoot, 'apt-get', ...args] as [string, ...string[]];
    log(command.join(' '));
    const env = { ...process.env, DEBIAN_FRONTEND: 'noninteractive' };
    return (
      spawnSync(command[0], command.slice(1), { stdio: ['ignore', 'ignore', 'inherit'], env }).status === 0
    );
  };
  const wanted = ['install', '-y', '--no-install-recommends', ...packages];
  // A machine's package lists may be old or empty, so the second attempt follows an update.
  return apt(wanted) || (apt(['update']) && apt(wanted));
}

function cureFor(cargo: string | null): string {
  const missing = cargo === null ? 'Rust is missing' : `Rust's ${WASM_TARGET} target is missing`;
  const packages = cargo === null ? [...DEBIAN_PACKAGES, 'cargo-web'] : DEBIAN_PACKAGES;
  if (isDebian()) return `${missing}: run \`apt-get install ${packages.join(' ')}\` as root.`;
  if (cargo !== null) return `${missing}: run \`rustup target add ${WASM_TARGET}\`.`;
  return `${missing}: install it from https://rustup.rs with the option \`--target ${WASM_TARGET}\`.`;
}

function findCargo(): string | null {
  const own = join(process.env.CARGO_HOME ?? join(homedir(), '.cargo'), 'bin', 'cargo');
  for (const candidate of ['cargo', own]) {
    if (succeeds(candidate, ['--version'])) return candidate;
  }
  return null;
}

/** Debian itself, because not all of its derivatives have these packages. */
function isDebian(): boolean {
  try {
    return /^ID=["']?debian["']?$/m.test(readFileSync('/etc/os-release', 'utf8'));
  } catch {
    return false;
  }
}

function output(command: string, args: string[]): string | null {
  const result = spawnSync(command, args, { encoding: 'utf8', timeout: 20_000 });
  return result.status === 0 ? result.stdout.trim() : null;
}

function succeeds(command: string, args: string[], timeout = 20_000): boolean {
  return spawnSync(command, args, { stdio: 'ignore', timeout }).status === 0;
}
