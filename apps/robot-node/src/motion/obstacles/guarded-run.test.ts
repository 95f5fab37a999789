/** Full speed ahead among walls, furniture, people and holes: a few runs. `pnpm bench guard-runs` makes a thousand. */
import { casesOf, shareInEachRun, someOf } from '@farpoint/network-sim/cases';
import { defaultObstacleGuardOptions } from '@farpoint/safety';
import { dockWorld } from '@farpoint/sim';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { expect, it } from 'vitest';
import { type GuardedRun, guardedRun, RUN_WORLDS, type RunSensors } from '../../testing/guarded-run.ts';

it.each(someOf(RUN_WORLDS, 0, shareInEachRun(1 / 2)).map((world) => [world().name, world] as const))(
  'drives into nothing, and stops for nothing: %s',
  async (_, world) => {
    const codec = await loadCodecFromDisk();
    const runs: GuardedRun[] = [];
    for (let seed = 1; seed <= casesOf(5); seed++)
      runs.push(await guardedRun(codec, world, seed, { seconds: 8 }));
    expect(runs.flatMap(contactsOf)).toEqual([]);
    expect(runs.flatMap(({ unseenContacts }) => unseenContacts)).toEqual([]);
    // Nor over an edge, nor near one.
    expect(Math.min(...runs.map(({ nearestEdgeM }) => nearestEdgeM))).toBeGreaterThan(0.12);
    const sum = (of: (run: GuardedRun) => number) => runs.reduce((total, run) => total + of(run), 0);
    expect(sum(({ falseStops }) => falseStops)).toBeLessThanOrEqual(
      0.02 * sum(({ freeCommands }) => freeCommands),
    );
    // They did drive.
    expect(sum(({ metres }) => metres) / runs.length).toBeGreaterThan(0.8);
  },
  30_000,
);

it('drives into nothing that sensors anywhere on it have seen, and into nothing faster than unseen space allows', async () => {
  const codec = await loadCodecFromDisk();
  const runs: GuardedRun[] = [];
  for (let seed = 1; seed <= casesOf(12, shareInEachRun(1 / 12)); seed++) {
    const world = RUN_WORLDS[seed % RUN_WORLDS.length] as (typeof RUN_WORLDS)[number];
    runs.push(await guardedRun(codec, world, seed, { seconds: 8, sensors: 'drawn' }));
  }
  expect(runs.flatMap(contactsOf)).toEqual([]);
  expect(runs.filter(({ fellAtS, fellUnseen }) => fellAtS !== null && !fellUnseen)).toEqual([]);
  for (const { unseenContacts } of runs) {
    for (const { speed } of unseenContacts)
      expect(Math.abs(speed)).toBeLessThanOrEqual(defaultObstacleGuardOptions.unseenMps + 1e-9);
  }
  expect(runs.reduce((sum, { metres }) => sum + metres, 0) / runs.length).toBeGreaterThan(0.8);
}, 60_000);

it('keeps away from holes of whose insides the camera gives nothing', async () => {
  const codec = await loadCodecFromDisk();
  // Past the corner of a hatch, and along its edge.
  for (const seed of [100, 132]) {
    const run = await guardedRun(codec, dockWorld, seed, { seconds: 8 });
    expect([run.fellAtS, run.contacts]).toEqual([null, []]);
    expect(run.nearestEdgeM).toBeLessThan(0.4);
    expect(run.nearestEdgeM).toBeGreaterThan(0.12);
  }
}, 30_000);

it('sees a hole beside which it begins with a camera that looks down', async () => {
  const codec = await loadCodecFromDisk();
  const nearest = async (sensors: RunSensors) =>
    (await guardedRun(codec, dockWorld, 564, { seconds: 4, sensors })).nearestEdgeM;
  expect(await nearest('camera')).toBeLessThan(0.1);
  expect(await nearest('camera-and-floor')).toBeGreaterThan(0.12);
}, 30_000);

function contactsOf({ contacts, seed, world }: GuardedRun) {
  return contacts.map((contact) => ({ ...contact, seed, world }));
}
