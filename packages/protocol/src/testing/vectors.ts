import { readFileSync } from 'node:fs';

/** The conformance vectors of this name. @typeParam Vectors what is in that file */
export function readVectors<Vectors>(name: string): Vectors {
  return JSON.parse(readFileSync(new URL(`../../vectors/${name}.json`, import.meta.url), 'utf8')) as Vectors;
}
