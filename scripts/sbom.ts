/** `pnpm run sbom`: writes the bill of materials of everything that is deployed. */
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, relative, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { readBill, withCrates } from './lib/bill-of-materials.ts';
import { readCargoLock } from './lib/cargo-lock.ts';
import { root, run } from './lib/run.ts';

const HELP = `pnpm run sbom [--output FILE]

Writes a software bill of materials (CycloneDX 1.6, JSON): the npm packages that programs and pages use when they run,
with their licences, and every Rust crate of wasm-codec/Cargo.lock, also those that only build and test it.

  --output FILE  default: release/farpoint.cdx.json
`;

const { values } = parseArgs({
  options: {
    output: { type: 'string', default: join(root, 'release', 'farpoint.cdx.json') },
    help: { type: 'boolean', short: 'h', default: false },
  },
});
if (values.help) {
  process.stdout.write(HELP);
} else {
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-sbom-'));
  try {
    const draft = join(folder, 'npm.cdx.json');
    // Without `run`, this is pnpm's own command.
    const format = ['--sbom-format', 'cyclonedx', '--sbom-spec-version', '1.6', '--sbom-type', 'application'];
    const { code, output } = await run('pnpm', ['sbom', '--prod', ...format, '--out', draft]);
    if (code !== 0) throw new Error(`pnpm sbom failed:\n${output}`);
    const crates = readCargoLock(readFileSync(join(root, 'wasm-codec', 'Cargo.lock'), 'utf8'));
    const bill = withCrates(readBill(readFileSync(draft, 'utf8')), crates);
    const path = resolve(values.output);
    mkdirSync(dirname(path), { recursive: true });
    writeFileSync(path, `${JSON.stringify(bill, null, 2)}\n`);
    console.log(`${relative('', path)}: ${bill.components.length} components`);
  } finally {
    rmSync(folder, { recursive: true });
  }
}
