/**
 * Only complete frames, and no deadlock, while producer and reader are killed at random: a short run here, a longer one
 * with `pnpm test --all`; `pnpm bench shm --kill 100000` is the long run.
 */
import { describe, expect, it } from 'vitest';
import { ADDON_SUITE, scratchFolder } from './testing/helpers.ts';
import { runKillTest } from './testing/kill-test.ts';
import { arePackedWhole, areWordsWhole, fillPacked, fillWords } from './testing/marked-frames.ts';

const KILLS = process.env.FARPOINT_LONG_TESTS
  ? { frames: 1000, leastKills: 4 }
  : { frames: 100, leastKills: 1 };

describe('marked frames', () => {
  it('reveal a single word of another frame', () => {
    const room = { points: new Float32Array(1600), depth: new Float32Array(0), colour: new Uint32Array(0) };
    const words = new Uint32Array(room.points.buffer);
    const frame = { points: 400 } as Parameters<typeof areWordsWhole>[0];
    fillWords(words, 7);
    expect(areWordsWhole(frame, room)).toBe(true);
    const other = new Uint32Array(1600);
    fillWords(other, 8);
    for (const at of [0, 777, 1599]) {
      fillWords(words, 7);
      words[at] = other[at] as number;
      expect(areWordsWhole(frame, room)).toBe(false);
    }
  });

  it('reveal a single packed value of another frame', () => {
    const unpacked = (edit: (values: Int16Array, other: Int16Array) => void) => {
      const [packed, next] = [new Uint8Array(8 * 160), new Uint8Array(8 * 160)];
      fillPacked(packed, 29_990);
      fillPacked(next, 29_991);
      const values = new Int16Array(packed.buffer);
      edit(values, new Int16Array(next.buffer));
      const points = new Float32Array(640);
      const words = new Uint32Array(points.buffer);
      for (let i = 0; i < 160; i++) {
        const [from, count, index] = i < 150 ? [0, 150, i] : [600, 10, i - 150];
        for (let axis = 0; axis < 3; axis++)
          points[i * 4 + axis] = (values[from + index * 3 + axis] as number) / 1000;
        words[i * 4 + 3] = values[from + count * 3 + index] as number;
      }
      return arePackedWhole(points, 160);
    };
    expect(unpacked(() => undefined)).toBe(true);
    for (const at of [0, 1, 2, 3, 451, 600, 601, 639])
      expect(unpacked((values, other) => values.set(other.subarray(at, at + 1), at))).toBe(false);
  });
});

describe.skipIf(ADDON_SUITE.skip)(`killed at random (${ADDON_SUITE.note})`, { timeout: 300_000 }, () => {
  it.each(['farpoint', 'reference'] as const)('%s: no torn frame, no deadlock', async (layout) => {
    const result = await runKillTest({
      ...{ layout, folder: scratchFolder(), ...KILLS, points: 6000, seed: 11, lifeMs: [10, 250] },
    });
    expect(result.torn).toBe(0);
    expect(result.frames).toBeGreaterThanOrEqual(KILLS.frames);
  });
});
