import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const packages = new URL('../../', import.meta.url);

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

/** Inputs that were worth keeping: `corpus/PARSER.json`, a list of base64. */
export function corpusOf(target: string): Uint8Array[] {
  const folder = fileURLToPath(new URL('../corpus/', import.meta.url));
  if (!readdirSync(folder).includes(`${target}.json`)) return [];
  const texts = JSON.parse(readFileSync(`${folder}${target}.json`, 'utf8')) as string[];
  return texts.map((text) => Uint8Array.from(Buffer.from(text, 'base64')));
}
