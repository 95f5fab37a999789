/** `pnpm run sbom`: writes the bill of materials of everything that is deployed. */
import { join, relative, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { root } from './lib/run.ts';
import { writeBill } from './lib/write-bill.ts';

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
  const path = resolve(values.output);
  console.log(`${relative('', path)}: ${await writeBill(path)} components`);
}
