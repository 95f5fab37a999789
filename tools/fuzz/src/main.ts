#!/usr/bin/env node
/** `pnpm fuzz`: mutated inputs for everything that reads bytes from outside. */
import { writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { allTargets } from './all-targets.ts';
import type { FuzzResult } from './fuzz.ts';
import { HANG_MS, supervise } from './supervise.ts';
import { corpusOf } from './vectors.ts';

const USAGE = `pnpm fuzz [--inputs 200000] [--only PARSER,…] [--seed 1] [--json] [--save] [--list]

Changes valid inputs at random and lets each parser read them. An error of a type that the parser does not document is a
crash; an input that takes longer than ${HANG_MS / 1000} s is a hang. --inputs counts for all parsers together; readers of whole
files get fewer. The same seed gives the same inputs. --save adds inputs with new outcomes to tools/fuzz/corpus.
Exit status: 1 after a crash, a hang, or if memory that is in use has grown by more than 96 MB, 2 for invalid arguments.`;
/** What all parsers together may leave in memory, bytes: their own code and tables, and the inputs that were kept. */
const MAX_GROWTH_BYTES = 96 << 20;
/** What a corpus file holds at most. */
const MOST_SAVED = 24;

function fail(message: string): never {
  console.error(`${message}\n\n${USAGE}`);
  return process.exit(2);
}

function readArguments() {
  try {
    return parseArgs({
      options: {
        inputs: { type: 'string', default: '200000' },
        only: { type: 'string' },
        seed: { type: 'string', default: '1' },
        json: { type: 'boolean' },
        save: { type: 'boolean' },
        list: { type: 'boolean' },
        help: { type: 'boolean', short: 'h' },
      },
    }).values;
  } catch (error) {
    return fail(error instanceof Error ? error.message : String(error));
  }
}

function whole(name: string, text: string): number {
  const value = Number(text);
  return Number.isSafeInteger(value) && value > 0
    ? value
    : fail(`--${name} ${text}: must be a positive whole number`);
}

const megabytes = (bytes: number) => Math.round(bytes / 2 ** 20);
const base64 = (bytes: Uint8Array) => Buffer.from(bytes).toString('base64');

function row({ name, inputs, refused, outcomes, crashes, seconds, slowestMs }: FuzzResult): string {
  const rate = Math.round(inputs / Math.max(seconds, 1e-3)).toString();
  const cells = [
    String(inputs).padStart(10),
    rate.padStart(9),
    String(refused).padStart(10),
    String(outcomes).padStart(4),
  ];
  return `${name.padEnd(28)}${cells.join('  ')}  ${slowestMs.toFixed(1).padStart(8)} ms  ${crashes.length}`;
}

function save({ name, kept }: FuzzResult): void {
  const all = [...corpusOf(name), ...kept].slice(0, MOST_SAVED);
  if (all.length === 0) return;
  const path = fileURLToPath(new URL(`../corpus/${name}.txt`, import.meta.url));
  writeFileSync(path, `${all.map(base64).join('\n')}\n`);
}

const { only, json, help, list, ...values } = readArguments();
if (help) {
  console.log(USAGE);
  process.exit(0);
}
const wanted = only?.split(',');
const names = allTargets
  .map(({ name }) => name)
  .filter((name) => wanted === undefined || wanted.includes(name));
const unknown = wanted?.find((name) => !names.includes(name));
if (unknown !== undefined) fail(`--only: there is no parser ${unknown}`);
if (list) {
  console.log(names.join('\n'));
  process.exit(0);
}
const order = { names, inputs: whole('inputs', values.inputs), seed: whole('seed', values.seed) };
console.error(`${'parser'.padEnd(28)}    inputs   inputs/s     refused  ends      slowest  crashes   memory`);
const begun = performance.now();
const { results, hang, memory } = await supervise(order, (result, bytes) => {
  console.error(`${row(result)}  ${String(megabytes(bytes)).padStart(6)} MB`);
  for (const { error, input } of result.crashes) console.error(`    ${error}\n    ${base64(input)}`);
  if (values.save) save(result);
});
const seconds = (performance.now() - begun) / 1000;
const inputs = results.reduce((sum, result) => sum + result.inputs, 0);
const crashes = results.reduce((sum, result) => sum + result.crashes.length, 0);
console.error(
  `${inputs} inputs for ${results.length} parsers in ${seconds.toFixed(0)} s (${Math.round(inputs / seconds)} a second): ` +
    `${crashes} crashes, ${hang === null ? 'no hang' : `a hang of ${hang.name}`}; ` +
    `memory ${megabytes(memory.first)} MB after the first parser, ${megabytes(memory.last)} MB after the last`,
);
if (hang !== null) console.error(`    ${base64(hang.input)}`);
if (json) {
  const shown = results.map(({ kept: _, slowestInput, crashes: found, ...result }) => ({
    ...result,
    slowestInput: base64(slowestInput),
    crashes: found.map(({ error, input }) => ({ error, input: base64(input) })),
  }));
  console.log(JSON.stringify({ seconds, inputs, memory, hang: hang?.name ?? null, results: shown }));
}
const complete = results.length === names.length;
const grown = memory.last - memory.first > MAX_GROWTH_BYTES;
process.exit(crashes === 0 && hang === null && complete && !grown ? 0 : 1);
