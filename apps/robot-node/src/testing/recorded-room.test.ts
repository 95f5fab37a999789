/** Recorded clouds as the sensor: a few runs towards real furniture. `pnpm bench guard-runs --rooms` makes a thousand. */

import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { casesOf } from '@farpoint/network-sim/cases';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, it } from 'vitest';
import { roomRun } from './recorded-room.ts';
import { readRooms } from './room-files.ts';

const clouds = fileURLToPath(new URL('../../../../../shared/data/clouds/', import.meta.url));

describe.skipIf(!existsSync(clouds))('recorded rooms (skipped without ../shared/data)', () => {
  it('are driven in without a contact, and without stopping for nothing', async () => {
    const codec = await loadCodecFromDisk();
    const { rooms, skipped } = readRooms(clouds);
    expect(rooms.map(({ name }) => name)).toEqual(['rgbd-sequence', 'kinect-room']);
    expect(skipped).toEqual(['stereo-table: it shows no floor to stand on']);
    for (const room of rooms) {
      const runs = [1, 2, 3].slice(0, casesOf(3)).map((seed) => roomRun(codec, room, seed, 6));
      expect(runs.flatMap(({ contacts }) => contacts)).toEqual([]);
      const sum = (of: (run: (typeof runs)[number]) => number) =>
        runs.reduce((total, run) => total + of(run), 0);
      expect(sum(({ falseStops }) => falseStops)).toBeLessThanOrEqual(
        0.02 * sum(({ freeCommands }) => freeCommands),
      );
      expect(sum(({ metres }) => metres) / runs.length).toBeGreaterThan(0.5);
      expect(sum(({ stops }) => stops)).toBeGreaterThan(0);
    }
  }, 60_000);
});
