import { Random } from '@farpoint/network-sim/random';
import type { FuzzTarget } from './fuzz-target.ts';
import { mutate } from './mutate.ts';

const DEFAULT_MAX_BYTES = 2048;
/** Inputs with a new outcome that are mutated in their turn. */
const MOST_KEPT = 256;
const MOST_CRASHES = 10;

export interface Crash {
  /** Name and message of the error. */
  error: string;
  stack: string;
  input: Uint8Array;
}

export interface FuzzResult {
  name: string;
  inputs: number;
  /** Inputs that were refused with an error of an expected type. */
  refused: number;
  /** Different outcomes: none, and each kind of refusal. */
  outcomes: number;
  crashes: readonly Crash[];
  seconds: number;
  slowestMs: number;
  slowestInput: Uint8Array;
  /** Inputs that had a new outcome. */
  kept: readonly Uint8Array[];
}

export interface FuzzOptions {
  inputs: number;
  seed: number;
  /** In addition to the target's own seeds. */
  corpus?: readonly Uint8Array[];
  /** Called with each input before it is read, so that somebody can say which one hangs. */
  onInput?: (input: Uint8Array) => void;
}

/** Reads mutated inputs one after another. All seeds are read first, unchanged. */
export async function fuzz(
  target: FuzzTarget,
  { inputs, seed, corpus = [], onInput }: FuzzOptions,
): Promise<FuzzResult> {
  const { name, run, refusals, maxBytes = DEFAULT_MAX_BYTES } = target;
  const seeds = [...(await target.seeds()), ...corpus];
  const known = [...seeds];
  const random = new Random(seed, hashOf(name));
  const outcomes = new Set<string>();
  const crashes: Crash[] = [];
  const kept: Uint8Array[] = [];
  let [refused, slowestMs, slowestInput] = [0, 0, new Uint8Array(0)];
  const begun = performance.now();
  for (let n = 0; n < inputs; n++) {
    const input = n < seeds.length ? (seeds[n] as Uint8Array) : mutate(known, random, maxBytes);
    onInput?.(input);
    const from = performance.now();
    let outcome = '';
    try {
      const promise = run(input);
      if (promise !== undefined) await promise;
    } catch (error) {
      refused++;
      outcome = signatureOf(error);
      if (!refusals.includes(nameOf(error))) addCrash(crashes, error, input);
    }
    const ms = performance.now() - from;
    if (ms > slowestMs) [slowestMs, slowestInput] = [ms, Uint8Array.from(input)];
    if (!outcomes.has(outcome)) {
      outcomes.add(outcome);
      if (n >= seeds.length && kept.length < MOST_KEPT) {
        kept.push(input);
        known.push(input);
      }
    }
  }
  const seconds = (performance.now() - begun) / 1000;
  return { name, inputs, refused, outcomes: outcomes.size, crashes, seconds, slowestMs, slowestInput, kept };
}

function addCrash(crashes: Crash[], error: unknown, input: Uint8Array): void {
  const text = error instanceof Error ? `${error.name}: ${error.message}` : String(error);
  const signature = signatureOf(error);
  if (crashes.length >= MOST_CRASHES || crashes.some((crash) => withoutNumbers(crash.error) === signature))
    return;
  crashes.push({
    error: text,
    stack: error instanceof Error ? (error.stack ?? '') : '',
    input: Uint8Array.from(input),
  });
}

function nameOf(error: unknown): string {
  return error instanceof Error ? error.name : typeof error;
}

/** The error without what differs from input to input. */
function signatureOf(error: unknown): string {
  return withoutNumbers(error instanceof Error ? `${error.name}: ${error.message}` : String(error));
}

function withoutNumbers(text: string): string {
  return text
    .slice(0, 200)
    .replaceAll(/["'“‘].*["'”’]/g, '"…"')
    .replaceAll(/-?\d[\d.,e+-]*/g, '#');
}

function hashOf(text: string): number {
  let hash = 0;
  for (const character of text) hash = (Math.imul(hash, 31) + (character.codePointAt(0) ?? 0)) | 0;
  return hash;
}
