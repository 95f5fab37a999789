/** The bill of materials of everything that is deployed. */
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { readBill, withCrates } from './bill-of-materials.ts';
import { readCargoLock } from './cargo-lock.ts';
import { root, run } from './run.ts';

/**
 * Writes it as CycloneDX 1.6, JSON.
 *
 * @returns how many components it has
 * @throws {Error} if pnpm does not list its packages
 */
export async function writeBill(path: string): Promise<number> {
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-sbom-'));
  try {
    const draft = join(folder, 'npm.cdx.json');
    // Without `run`, this is pnpm's own command.
    const format = ['--sbom-format', 'cyclonedx', '--sbom-spec-version', '1.6', '--sbom-type', 'application'];
    const { code, output } = await run('pnpm', ['sbom', '--prod', ...format, '--out', draft]);
    if (code !== 0) throw new Error(`pnpm sbom failed:\n${output}`);
    const crates = readCargoLock(readFileSync(join(root, 'wasm-codec', 'Cargo.lock'), 'utf8'));
    const bill = withCrates(readBill(readFileSync(draft, 'utf8')), crates);
    mkdirSync(dirname(path), { recursive: true });
    writeFileSync(path, `${JSON.stringify(bill, null, 2)}\n`);
    return bill.components.length;
  } finally {
    rmSync(folder, { recursive: true });
  }
}
