/** `pnpm bench guard-runs`: seeded drives at full speed under the obstacle guard. */
import { join } from 'node:path';
import {
  type GuardedRun,
  type GuardTimes,
  guardedRun,
  RUN_SENSORS,
  RUN_WORLDS,
  type RunSensors,
} from '@farpoint/robot-node/testing/guarded-run';
import { roomRun } from '@farpoint/robot-node/testing/recorded-room';
import { readRooms } from '@farpoint/robot-node/testing/room-files';
import type { Codec } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import { Progress } from './progress.ts';
import { type Bench, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench guard-runs [--runs 1000] [--seed 1] [--seconds 12] [--world NAME] [--sensors camera|camera-and-floor|drawn] [--json]
       pnpm bench guard-runs --rooms [--clouds ../shared/data/clouds] [--runs 1000] …

Simulated time, in one process. In each run a robot somewhere in one of four worlds is told to go full speed ahead, at a
speed up to its limit, on changing arcs, while people and carts cross its way; where the guard stops it, it turns on the spot
and goes on. Counts what it drives into, where it goes over an edge, and the commands for which it stopped although the way was free.
With --sensors camera-and-floor, a second camera looks down at the floor around the robot. With drawn, each run has one to
three cameras, each anywhere within 0.5 m of the robot's middle, pitched by up to 0.7 rad and turned any way; a robot is as
wide as its sensors need, and drives to the side to which they look. What none of them had seen for half a second before the
robot touched it, or fell into it, is counted apart, as unseen.

With --rooms, the robot drives in recorded clouds that show a floor: its camera sees their points from where it is, and it
starts where they were recorded, or up to half a metre from there. Contacts and false stops are those with their points.`;

const OPTIONS = {
  runs: option.number(1000, { least: 1 }),
  seed: option.number(1),
  seconds: option.number(12, { least: 1 }),
  world: option.text(),
  sensors: option.choice('camera', RUN_SENSORS),
  rooms: option.flag,
  clouds: option.text(join(import.meta.dirname, '../../../shared/data/clouds')),
};
type Options = OptionValues<typeof OPTIONS>;

export const bench: Bench = {
  name: 'guard-runs',
  summary: 'simulated drives at full speed under the obstacle guard: contacts and false stops',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    const codec = await loadCodecFromDisk();
    const drives = options.rooms
      ? roomDrives(codec, options.clouds)
      : worldDrives(codec, options.world, options.sensors);
    if (drives.length === 0) return;
    const boundMs: number[] = [];
    const runs = await driveAll(drives, options, { now: () => performance.now(), boundMs });
    const rows = [...new Set(runs.map(({ world }) => world)), 'all'].map((world) =>
      summaryOf(
        world,
        runs.filter((run) => world === 'all' || run.world === world),
      ),
    );
    const all = rows.at(-1);
    const bound = rounded(distribution(boundMs), 4);
    print(rows);
    const unseenMps = all?.unseenMps ?? 0;
    if (unseenMps > 0) console.log(`fastest into what was not seen: ${unseenMps.toFixed(2)} m/s`);
    console.log(`a command: p50 ${bound.p50} ms, p95 ${bound.p95} ms, max ${bound.max} ms`);
    if (options.json)
      printJson({ bench: 'guard-runs', ...all, falseStops: all?.falseShare, boundMs: bound, rows });
  },
};

/** Drives in each of the places in turn, and prints each contact and fall at once. */
async function driveAll(
  drives: readonly Drive[],
  { runs: count, seed, seconds }: Options,
  times: GuardTimes,
): Promise<GuardedRun[]> {
  const runs: GuardedRun[] = [];
  const progress = new Progress(count, 'runs');
  for (let i = 0; i < count; i++) {
    const drive = drives[i % drives.length] as Drive;
    const run = await drive(seed + i, seconds, times);
    runs.push(run);
    progress.update(runs.length);
    for (const { atS, speed } of run.contacts) {
      console.log(`${run.world}, seed ${run.seed}: contact at ${atS.toFixed(2)} s, ${speed.toFixed(2)} m/s`);
    }
    if (run.fellAtS !== null && !run.fellUnseen)
      console.log(`${run.world}, seed ${run.seed}: over an edge at ${run.fellAtS.toFixed(2)} s`);
  }
  progress.end();
  return runs;
}

function print(rows: readonly ReturnType<typeof summaryOf>[]): void {
  printTable(
    [
      'world',
      'runs',
      'metres',
      'contacts',
      'falls',
      'unseen',
      'edge cm',
      'stops',
      'free commands',
      'false stops',
      '%',
    ],
    rows.map((row) => [
      row.world,
      row.runs,
      Math.round(row.metres),
      row.contacts,
      row.falls,
      row.unseen,
      row.nearestEdgeM === null ? '' : (100 * row.nearestEdgeM).toFixed(1),
      row.stops,
      row.freeCommands,
      row.falseStops,
      100 * row.falseShare,
    ]),
  );
}

/** One run in one of the places. */
export type Drive = (seed: number, seconds: number, times: GuardTimes) => GuardedRun | Promise<GuardedRun>;

export function worldDrives(codec: Codec, name?: string, sensors: RunSensors = 'camera'): Drive[] {
  const worlds = RUN_WORLDS.filter((world) => name === undefined || world().name === name);
  if (worlds.length === 0) throw new Error(`no world is named ${name}`);
  return worlds.map(
    (world) => (seed, seconds, times) => guardedRun(codec, world, seed, { seconds, times, sensors }),
  );
}

function roomDrives(codec: Codec, folder: string): Drive[] {
  const { rooms, skipped } = readRooms(folder);
  for (const why of skipped) console.log(`skipped, ${why}`);
  for (const { name, heightM, things } of rooms)
    console.log(`${name}: camera ${heightM.toFixed(2)} m above the floor, ${things} points of things`);
  return rooms.map((room) => (seed, seconds, times) => roomRun(codec, room, seed, seconds, times));
}

export function summaryOf(world: string, runs: readonly GuardedRun[]) {
  const sum = (of: (run: GuardedRun) => number) => runs.reduce((total, run) => total + of(run), 0);
  const freeCommands = sum((run) => run.freeCommands);
  const falseStops = sum((run) => run.falseStops);
  const nearest = Math.min(...runs.map(({ nearestEdgeM }) => nearestEdgeM));
  return {
    world,
    runs: runs.length,
    metres: sum((run) => run.metres),
    contacts: sum((run) => run.contacts.length),
    stops: sum((run) => run.stops),
    falls: runs.filter(({ fellAtS, fellUnseen }) => fellAtS !== null && !fellUnseen).length,
    ...unseenOf(runs),
    nearestEdgeM: Number.isFinite(nearest) ? nearest : null,
    freeCommands,
    falseStops,
    falseShare: freeCommands === 0 ? 0 : falseStops / freeCommands,
  };
}

/** How often a robot touched, or fell over, what no sensor had seen; and how fast it was then at most, m/s. */
function unseenOf(runs: readonly GuardedRun[]) {
  const speeds = runs.flatMap(({ unseenContacts }) => unseenContacts.map(({ speed }) => Math.abs(speed)));
  const falls = runs.filter(({ fellUnseen }) => fellUnseen).length;
  return { unseen: speeds.length + falls, unseenMps: Math.max(0, ...speeds) };
}
