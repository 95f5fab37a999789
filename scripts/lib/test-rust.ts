import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { buildWasm, checkFresh, findWasmToolchain, NoWasmToolchainError, readRecord } from '../build-wasm.ts';
import { CARGO_WORKSPACE } from '../wasm-table.ts';
import { root, run } from './run.ts';

export interface RustResult {
  ok: boolean;
  output: string;
  /** What could not run here, with the remedy. The hashes of the committed modules are checked regardless. */
  skipped?: string;
}

/**
 * The Rust part of the tests. The committed modules match their sources: by their hashes and, with `rebuild`, because
 * they build from source, with the recorded compiler to the same bytes. Format, clippy, unit tests.
 */
export async function testRust(
  say: (line: string) => void,
  options: { rebuild: boolean },
): Promise<RustResult> {
  const stale = checkFresh();
  if (stale.length > 0) {
    const list = stale.map(({ name, outDir, reason }) => `${outDir}: ${name} is stale (${reason})`);
    return { ok: false, output: [...list, 'run: pnpm build:wasm'].join('\n') };
  }

  const skipped: string[] = [];
  try {
    const fault = options.rebuild ? rebuild(say) : null;
    if (fault !== null) return { ok: false, output: fault };
  } catch (error) {
    if (!(error instanceof NoWasmToolchainError)) {
      return { ok: false, output: error instanceof Error ? error.message : String(error) };
    }
    skipped.push(error.message);
  }

  // Of the crate that only builds modules, the dependencies take longer to compile than all others.
  const crates = ['--workspace', ...(options.rebuild ? [] : ['--exclude', 'xtask'])];
  const cwd = join(root, CARGO_WORKSPACE);
  let output = '';
  for (const { tool, args, remedy } of [
    { tool: 'fmt', args: ['fmt', '--all', '--check'], remedy: 'rustup component add rustfmt' },
    {
      tool: 'clippy',
      args: ['clippy', ...crates, '--all-targets', '--locked', '--', '-D', 'warnings'],
      remedy: 'rustup component add clippy',
    },
    {
      tool: 'test',
      args: ['test', ...crates, '--locked'],
      remedy: 'install Rust from https://rustup.rs',
    },
  ]) {
    if ((await run('cargo', [tool, '--help'])).code !== 0) {
      skipped.push(`cargo ${tool} is missing: run \`${remedy}\`.`);
      continue;
    }
    say(`cargo ${args.slice(0, 2).join(' ')}`);
    const result = await run('cargo', args, { cwd });
    output += result.output;
    if (result.code !== 0) return { ok: false, output };
  }
  return { ok: true, output, ...(skipped.length > 0 ? { skipped: skipped.join(' ') } : {}) };
}

/** Builds every module separately from the committed ones. @returns what is wrong, or `null` */
function rebuild(say: (line: string) => void): string | null {
  const toolchain = findWasmToolchain({ log: say });
  const scratch = mkdtempSync(join(tmpdir(), 'farpoint-rebuild-'));
  try {
    for (const built of buildWasm({ outOfTree: scratch, toolchain, log: say })) {
      const committed = readRecord(join(root, built.crate.outDir));
      if (committed?.toolchain !== built.record.toolchain) {
        say(
          `${built.crate.name}: built; the toolchain differs from the recorded one, so bytes are not compared`,
        );
        continue;
      }
      for (const file of [
        `${built.crate.name}_bg.wasm`,
        `${built.crate.name}.js`,
        `${built.crate.name}.d.ts`,
      ]) {
        const fresh = readFileSync(join(built.folder, file));
        if (!fresh.equals(readFileSync(join(root, built.crate.outDir, file)))) {
          return `${built.crate.outDir}/${file} is not what its sources build to; run: pnpm build:wasm`;
        }
      }
    }
    return null;
  } finally {
    rmSync(scratch, { recursive: true, force: true });
  }
}
