#!/usr/bin/env node
/** `pnpm attack`: attacks the real programs on this machine and prints what came of it. */
import { constants } from 'node:os';
import { parseArgs } from 'node:util';
import { allAttacks } from './all-attacks.ts';
import { LAYERS } from './attack.ts';
import { printFlood, printSummary, row } from './report.ts';
import { runAttacks } from './run-attacks.ts';
import { runFlood } from './run-flood.ts';

const USAGE = `pnpm attack [--only TEXT] [--list] [--json]
pnpm attack --flood SECONDS [--rate 10000] [--only TEXT] [--json]

Starts signaling, two robots (one admits only who has a grant) and a bridge on this machine, lets an operator drive, and
attacks them, one attack after another. An attack is held if afterwards the operator still drives in the same session with
the same lease, others are introduced as before, no program has ended, and none has grown by more than 128 MB.

The attacks of the layer peer come from an operator that may watch: one packet a thousand times, after the worst state that
it can set up. Held means also that the robot's main thread never paused for more than 150 ms, spent no more than 500 µs
on a packet, and grew by no more than 50 MB.

--flood sends datagrams of each kind at a rate for this long while the operator drives, and prints command and frame latency
before and during, lost sessions, and the robot's memory.

--only takes attacks whose layer is TEXT, or whose name contains it (layers: ${LAYERS.join(', ')}).
Exit status: 1 if an attack did harm or could not be tried, 2 for invalid arguments.`;

function fail(message: string): never {
  console.error(`${message}\n\n${USAGE}`);
  return process.exit(2);
}

/** Ends once all of the output is written: a pipe takes a part at a time. */
function finish(code: number, output: string): Promise<never> {
  return new Promise(() => process.stdout.write(output, () => process.exit(code)));
}

function readArguments() {
  try {
    return parseArgs({
      options: {
        only: { type: 'string' },
        list: { type: 'boolean' },
        json: { type: 'boolean' },
        flood: { type: 'string' },
        rate: { type: 'string', default: '10000' },
        help: { type: 'boolean', short: 'h' },
      },
    }).values;
  } catch (error) {
    return fail(error instanceof Error ? error.message : String(error));
  }
}

const { only, list, json, help, ...values } = readArguments();
if (help) {
  console.log(USAGE);
  process.exit(0);
}

function positive(name: string, text: string): number {
  const value = Number(text);
  return Number.isFinite(value) && value > 0 ? value : fail(`--${name} ${text}: must be a positive number`);
}

// Exiting ends all programs, which dying from a signal would not.
for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP'] as const)
  process.on(signal, () => process.exit(128 + constants.signals[signal]));

if (values.flood !== undefined) {
  const seconds = positive('flood', values.flood);
  const results = await runFlood({ seconds, perSecond: positive('rate', values.rate), only });
  if (results.length === 0) fail(`--only ${only}: no such datagrams`);
  if (!json) printFlood(results);
  await finish(results.some(({ harm }) => harm !== null) ? 1 : 0, json ? `${JSON.stringify(results)}\n` : '');
}

const chosen = allAttacks.filter(
  ({ name, layer }) => only === undefined || layer === only || name.includes(only),
);
if (chosen.length === 0) fail(`--only ${only}: no such attack`);
if (list) {
  await finish(0, chosen.map(({ layer, name }) => `${layer.padEnd(9)}  ${name}\n`).join(''));
}
const results = await runAttacks(chosen, (result) => console.error(row(result)));
printSummary(results);
const held = results.every(({ outcome }) => outcome === 'held');
await finish(held ? 0 : 1, json ? `${JSON.stringify(results)}\n` : '');
