import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Codec } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { beforeAll, describe, expect, it } from 'vitest';
import type { BenchCloud, CodecRun } from './adapter.ts';
import { pcdCloud, simulatedClouds } from './clouds.ts';
import { type CodecRow, measureCodec } from './measure.ts';
import { organised } from './organised.ts';
import { points64, zstd } from './points64.ts';
import { unorganised } from './unorganised.ts';

let codec: Codec;
let cloud: BenchCloud;
beforeAll(async () => {
  codec = await loadCodecFromDisk();
  [cloud] = (await simulatedClouds(1, 240)) as [BenchCloud];
});

function measure(made: CodecRun | string, of = cloud): CodecRow {
  if (typeof made === 'string') throw new Error(made);
  using run = made;
  return measureCodec(of, run, 1);
}

// Each encodes and decodes the frame dozens of times, which is slow on a busy computer.
describe('the codecs on a frame of the simulated camera', { timeout: 30_000 }, () => {
  it('points64: 64 bits, errors within half a millimetre', () => {
    const row = measure(points64(codec, cloud));
    expect([row.bitsPerPoint, row.sentPoints, row.maxPacketBytes]).toEqual([64, cloud.valid.length, 1200]);
    expect(row.depthErrorMm).toBeLessThan(0.51);
    expect(row.loss['20'].pointsWrong).toBe(0);
    expect(row.loss['20'].pointsLost).toBeCloseTo(0.2, 1);
  });

  it('unorganised: errors within half a step, no misplaced points under loss', () => {
    const row = measure(unorganised(codec, cloud, 5));
    expect(row.sentPoints).toBe(cloud.valid.length);
    expect(row.bitsPerPoint).toBeLessThan(15);
    expect(row.depthErrorMm).toBeLessThan(2.51);
    expect(row.colorPsnrDb).toBeGreaterThan(40);
    expect(row.maxPacketBytes).toBeLessThanOrEqual(1200);
    expect(Object.values(row.loss).map(({ pointsWrong }) => pointsWrong)).toEqual([0, 0, 0]);
  });

  it('organised: errors within the level’s bound, no misplaced points under loss', () => {
    const row = measure(organised(codec, cloud, { name: '', options: { depthLevel: 3 } }));
    expect(row.depthErrorMmPerZ2).toBeLessThan(0.51);
    expect(row.maxPacketBytes).toBeLessThanOrEqual(1200);
    expect(Object.values(row.loss).map(({ pointsWrong }) => pointsWrong)).toEqual([0, 0, 0]);
    expect(organised(codec, { ...cloud, height: 1 }, { name: '', options: {} })).toBe(
      'the cloud has no grid',
    );
  });

  it('zstd: one blob, lost if any packet is lost', () => {
    expect(measure(zstd(codec, cloud)).loss['20'].pointsLost).toBeGreaterThan(0.99);
  });
});

const street = fileURLToPath(new URL('../../../../shared/data/clouds/lidar-street.pcd', import.meta.url));
describe.skipIf(!existsSync(street))('a recorded LiDAR sweep (skipped without ../shared/data)', () => {
  it('takes less than 16 bits per point with intensity, on a grid of 10 mm', () => {
    const sweep = pcdCloud(street);
    const row = measure(unorganised(codec, sweep, 10), sweep);
    expect(row.bitsPerPoint).toBeLessThan(16);
    // Half the diagonal of a cell.
    expect(row.depthErrorMm).toBeLessThan(8.67);
    expect(row.loss['20'].pointsWrong).toBe(0);
  });
});
