/** Which groups of tests have passed on this machine, with which inputs. Kept for the user, not in the repository. */
import { mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { homedir } from 'node:os';
import { dirname, join } from 'node:path';
import * as z from 'zod';

/** Of several checkouts and branches. */
const KEPT_PER_GROUP = 12;

const provenSchema = z.record(
  z.string(),
  z.array(z.strictObject({ inputs: z.string(), tools: z.string(), at: z.iso.datetime() })),
);

type Proven = z.infer<typeof provenSchema>;
export type Proof = Proven[string][number];

/** `FARPOINT_CACHE`, or the folder for caches of this user. */
export function cacheFolder(
  env: NodeJS.ProcessEnv = process.env,
  platform: string = process.platform,
): string {
  if (env.FARPOINT_CACHE) return env.FARPOINT_CACHE;
  if (env.XDG_CACHE_HOME) return join(env.XDG_CACHE_HOME, 'farpoint');
  if (platform === 'win32' && env.LOCALAPPDATA) return join(env.LOCALAPPDATA, 'farpoint');
  return platform === 'darwin'
    ? join(homedir(), 'Library', 'Caches', 'farpoint')
    : join(homedir(), '.cache', 'farpoint');
}

export class ProvenGroups {
  readonly #file: string;
  readonly #proven: Proven;

  /** A file that is missing or damaged proves nothing. */
  constructor(file = join(cacheFolder(), 'passed.json')) {
    this.#file = file;
    this.#proven = readOrNothing(file);
  }

  /** @returns how this state of the group has passed with these tools; `undefined` if it has not */
  proof(group: string, inputs: string, tools: string): Proof | undefined {
    return this.#proven[group]?.find((proof) => proof.inputs === inputs && proof.tools === tools);
  }

  /** Whether the group has passed here, but never with these inputs: what it tests has changed since. */
  hasChanged(group: string, inputs: string): boolean {
    const proofs = this.#proven[group] ?? [];
    return proofs.length > 0 && !proofs.some((proof) => proof.inputs === inputs);
  }

  /** Keeps that a group has passed. A folder that cannot be written costs time, and no test. */
  keep(group: string, proof: Proof): void {
    const { inputs, tools } = proof;
    const others = (this.#proven[group] ?? []).filter(
      (each) => each.inputs !== inputs || each.tools !== tools,
    );
    this.#proven[group] = [proof, ...others].slice(0, KEPT_PER_GROUP);
    try {
      mkdirSync(dirname(this.#file), { recursive: true });
      writeFileSync(`${this.#file}.new`, JSON.stringify(this.#proven, null, 1));
      renameSync(`${this.#file}.new`, this.#file);
    } catch (error) {
      console.log(`  what has passed is not remembered: ${error instanceof Error ? error.message : error}`);
    }
  }
}

function readOrNothing(file: string): Proven {
  try {
    return provenSchema.parse(JSON.parse(readFileSync(file, 'utf8')));
  } catch {
    return {};
  }
}
