/** Which files of tests have passed on this machine, by hashes of all that they depend on. Kept for the user, not in the repository. */
import { mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import * as z from 'zod';
import { cacheFolder } from './proven.ts';

/** Of some twenty states of all files. */
const MOST = 20_000;

export class ProvenFiles {
  readonly #file: string;
  /** The newest are the last. */
  readonly #hashes: Set<string>;

  /** A file that is missing or damaged proves nothing. */
  constructor(file = join(cacheFolder(), 'passed-files.json')) {
    this.#file = file;
    this.#hashes = readOrNothing(file);
  }

  has(hash: string): boolean {
    return this.#hashes.has(hash);
  }

  /** Keeps what has passed. A folder that cannot be written costs time, and no test. */
  keep(hashes: readonly string[]): void {
    if (hashes.length === 0) return;
    for (const hash of hashes) {
      this.#hashes.delete(hash);
      this.#hashes.add(hash);
    }
    for (const hash of this.#hashes) {
      if (this.#hashes.size <= MOST) break;
      this.#hashes.delete(hash);
    }
    try {
      mkdirSync(dirname(this.#file), { recursive: true });
      writeFileSync(`${this.#file}.new`, JSON.stringify([...this.#hashes]));
      renameSync(`${this.#file}.new`, this.#file);
    } catch (error) {
      console.log(`  what has passed is not remembered: ${error instanceof Error ? error.message : error}`);
    }
  }
}

function readOrNothing(file: string): Set<string> {
  try {
    return new Set(z.array(z.string()).parse(JSON.parse(readFileSync(file, 'utf8'))));
  } catch {
    return new Set();
  }
}
