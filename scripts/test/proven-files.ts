/** Which files of tests have passed on this machine, by hashes of all that they depend on, and what they took. Kept for the user, not in the repository. */
import { mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import * as z from 'zod';
import type { PassedBefore } from './changed.ts';
import { cacheFolder } from './proven.ts';

/** Of some twenty states of all files. */
const MOST = 20_000;

const schema = z.object({
  tests: z.array(z.string()),
  inputs: z.array(z.string()),
  ms: z.record(z.string(), z.number()),
});

/** What is known of a run in which tests have passed. */
export interface Passed {
  /** Hashes of all that each test depends on. */
  tests: readonly string[];
  /** Hashes of the files on which they depend. */
  inputs: Iterable<string>;
  /** What files of tests and steps took, by their names. */
  ms: Readonly<Record<string, number>>;
}

export class ProvenFiles implements PassedBefore {
  readonly #file: string;
  /** The newest are the last. */
  readonly #tests: Set<string>;
  readonly #inputs: Set<string>;
  readonly #ms: Map<string, number>;

  /** A file that is missing or damaged proves nothing. */
  constructor(file = join(cacheFolder(), 'passed-files.json')) {
    this.#file = file;
    const { tests, inputs, ms } = readOrNothing(file);
    this.#tests = new Set(tests);
    this.#inputs = new Set(inputs);
    this.#ms = new Map(Object.entries(ms));
  }

  has(hash: string): boolean {
    return this.#tests.has(hash);
  }

  hasInput(hash: string): boolean {
    return this.#inputs.has(hash);
  }

  msOf(name: string): number | undefined {
    return this.#ms.get(name);
  }

  /** Keeps what has passed. A folder that cannot be written costs time, and no test. */
  keep({ tests, inputs, ms }: Passed): void {
    keepNewest(this.#tests, tests);
    keepNewest(this.#inputs, inputs);
    for (const [name, taken] of Object.entries(ms)) {
      this.#ms.delete(name);
      this.#ms.set(name, taken);
    }
    for (const name of [...this.#ms.keys()].slice(0, Math.max(0, this.#ms.size - MOST)))
      this.#ms.delete(name);
    const text = JSON.stringify({
      tests: [...this.#tests],
      inputs: [...this.#inputs],
      ms: Object.fromEntries(this.#ms),
    });
    try {
      mkdirSync(dirname(this.#file), { recursive: true });
      writeFileSync(`${this.#file}.new`, text);
      renameSync(`${this.#file}.new`, this.#file);
    } catch (error) {
      console.log(`  what has passed is not remembered: ${error instanceof Error ? error.message : error}`);
    }
  }
}

function keepNewest(all: Set<string>, newest: Iterable<string>): void {
  for (const each of newest) {
    all.delete(each);
    all.add(each);
  }
  for (const each of all) {
    if (all.size <= MOST) break;
    all.delete(each);
  }
}

function readOrNothing(file: string): z.infer<typeof schema> {
  try {
    return schema.parse(JSON.parse(readFileSync(file, 'utf8')));
  } catch {
    return { tests: [], inputs: [], ms: {} };
  }
}
