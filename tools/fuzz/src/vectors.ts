import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const packages = new URL('../../../packages/', import.meta.url);

/** Every input of a package's conformance vectors: `hex` and `text`, valid and invalid. */
export function vectors(packageName: string, name: string): Uint8Array[] {
  const found: Uint8Array[] = [];
  const path = new URL(`${packageName}/vectors/${name}.json`, packages);
  collect(JSON.parse(readFileSync(path, 'utf8')), found);
  return found;
}

function collect(value: unknown, into: Uint8Array[]): void {
  if (typeof value !== 'object' || value === null) return;
  for (const [key, part] of Object.entries(value)) {
    if (key === 'hex' && typeof part === 'string') into.push(Uint8Array.from(Buffer.from(part, 'hex')));
    else if (key === 'text' && typeof part === 'string') into.push(Uint8Array.from(Buffer.from(part)));
    else collect(part, into);
  }
}

/** Inputs that were worth keeping: `corpus/PARSER.txt`, a line of base64 for each. */
export function corpusOf(target: string): Uint8Array[] {
  const folder = fileURLToPath(new URL('../corpus/', import.meta.url));
  const name = `${target}.txt`;
  if (!readdirSync(folder).includes(name)) return [];
  const lines = readFileSync(folder + name, 'utf8').split('\n');
  return lines.map((line) => Uint8Array.from(Buffer.from(line, 'base64')));
}
