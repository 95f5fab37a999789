/** An admitted watcher sends one packet again and again, beside an admitted driver. */
import { readFileSync } from 'node:fs';
import { type Attack, attacks } from '../attack.ts';
import { HarmError, mustHold, pause } from '../harm.ts';
import { ROBOT, type Scene } from '../scene.ts';
import { SctpGuest } from '../sctp-guest.ts';
import {
  excessiveStrain,
  MAX_GROWTH_BYTES,
  type Reading,
  type Strain,
  strainOf,
  strainText,
} from './strain.ts';
import { worstState } from './worst-state.ts';

/** What an attack has sent, and what it has measured. */
export class Tally {
  readonly packets: number;
  readonly text: string;

  constructor(packets: number, text: string) {
    this.packets = packets;
    this.text = text;
  }
}

const PACKETS = 1000;
/** Sent at once, and the pause after them, ms: 4,000 a second, which a socket's buffer takes. */
const BURST = 40;
const BURST_MS = 10;
/** The guest's budget fills up again. */
const REST_MS = 2000;
/** On a busy machine, other programs make pauses, too, but not again and again. */
const TRIES = 3;

/** Prepares whatever the packets need, and returns what sends the nth of them. */
export type Pattern = (
  guest: SctpGuest,
  scene: Scene,
) => Promise<(n: number) => unknown> | ((n: number) => unknown);

export function repeated(patterns: Readonly<Record<string, Pattern>>): Attack[] {
  return attacks(
    'peer',
    Object.fromEntries(
      Object.entries(patterns).map(([name, pattern]) => [name, (scene: Scene) => repeat(scene, pattern)]),
    ),
  );
}

async function repeat(scene: Scene, pattern: Pattern): Promise<Tally> {
  let sent = 0;
  for (let tries = 1; ; tries++) {
    const attempt = await once(scene, pattern);
    sent += attempt.sent;
    const excess = excessiveStrain(attempt.strain);
    if (excess === null) return new Tally(sent, strainText(attempt.strain));
    mustHold(tries < TRIES, excess);
  }
}

/** With a guest of its own, whose numbers and state are new. */
async function once(scene: Scene, pattern: Pattern): Promise<{ strain: Strain; sent: number }> {
  const first = await read(scene);
  const guest = await SctpGuest.join(scene);
  const setUp = worstState(guest);
  await guest.raw(...setUp);
  const send = await pattern(guest, scene);
  const idle = [await read(scene), await rested(scene)] as const;
  for (let n = 0; n < PACKETS; n++) {
    send(n);
    if (n % BURST === BURST - 1) await pause(BURST_MS);
  }
  await pause(300);
  const last = await readSmaller(scene, first);
  await guest.operator.close();
  return { strain: strainOf({ first, idle, last }, PACKETS), sent: setUp.length + PACKETS };
}

async function rested(scene: Scene): Promise<Reading> {
  await pause(REST_MS);
  return read(scene);
}

/** Garbage may be left for a while. */
async function readSmaller(scene: Scene, first: Reading): Promise<Reading> {
  const { gapMs, atMs, processorMs } = await read(scene);
  for (let n = 0; n < 50 && scene.robotBytes - first.bytes > MAX_GROWTH_BYTES; n++) await pause(100);
  return { atMs, processorMs, gapMs, bytes: scene.robotBytes };
}

async function read(scene: Scene): Promise<Reading> {
  const { pid } = scene.stack.robot(ROBOT);
  // The longest since it was asked for last.
  const gapMs = 1000 * (await scene.metric('nodejs_eventloop_lag_max_seconds'));
  return { atMs: performance.now(), processorMs: mainThreadMs(pid), gapMs, bytes: scene.robotBytes };
}

/** Processor time of a process's main thread. */
function mainThreadMs(pid: number): number {
  try {
    return Number(readFileSync(`/proc/${pid}/task/${pid}/schedstat`, 'utf8').split(' ')[0]) / 1e6;
  } catch (error) {
    if (process.platform !== 'linux') return 0;
    throw new HarmError(`the robot has ended: ${String(error)}`);
  }
}
