import { emptyPlacement } from '@farpoint/protocol';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, it } from 'vitest';
import { BATCH_BYTES, Batch } from './batch.ts';
import type { BatchWriter } from './packet-decoder.ts';
import { Points64PacketDecoder } from './points64-packet-decoder.ts';

const codec = await loadCodecFromDisk();
const placement = emptyPlacement();

/** A writer with a single batch; nothing may be dropped. */
function writer(every: number): BatchWriter & { batch: Batch } {
  const batch = new Batch(new ArrayBuffer(BATCH_BYTES));
  const drop = (reason: string) => expect.unreachable(reason);
  return { every: 1, everySample: every, surface: false, batch, batchFor: () => batch, drop };
}

/** Blocks of a frame: x, y, z differ from point to point. */
function blocks(counts: readonly number[]): { data: Uint8Array; offset: number }[] {
  let [seed, offset] = [1, 0];
  return counts.map((count) => {
    const data = new Uint8Array(count * 8).map(() => {
      seed = (Math.imul(seed, 1_103_515_245) + 12_345) >>> 0;
      return seed >>> 16;
    });
    const block = { data, offset };
    offset += data.length;
    return block;
  });
}

function decode(every: number, counts: readonly number[]): Batch {
  const decoder = new Points64PacketDecoder(codec);
  const into = writer(every);
  const frameLength = counts.reduce((sum, count) => sum + count * 8, 0);
  for (const { data, offset } of blocks(counts)) {
    const header = { frameNumber: 7, frameLength, sequenceOffset: offset, sequenceLength: data.length };
    decoder.add(header, placement, data, 5, into);
  }
  decoder.finish(into.batch);
  return into.batch;
}

/** Points as four int16 each; the first value is enough to tell them apart. */
const pointsOf = (batch: Batch) =>
  Array.from({ length: batch.pointCount }, (_, i) => [...batch.points.subarray(i * 4, i * 4 + 4)]);

describe('Points64PacketDecoder', () => {
  const counts = [144, 144, 37, 1];

  it('hands on every point', () => {
    const batch = decode(1, counts);
    expect(batch.pointCount).toBe(326);
    expect(counts.map((_, i) => batch.pointsOf(i))).toEqual(counts);
  });

  it('hands on one of every few points of each packet, larger, and reports how many came', () => {
    const [whole, thin] = [decode(1, counts), decode(5, counts)];
    let rest = pointsOf(whole);
    const stretches = counts.flatMap((count) => {
      const packet = rest.slice(0, count);
      rest = rest.slice(count);
      return Array.from({ length: Math.ceil(count / 5) }, (_, i) => packet.slice(i * 5, i * 5 + 5));
    });
    const places = pointsOf(thin).map((point, i) =>
      (stretches[i] ?? []).findIndex((other) => other.join() === point.join()),
    );
    expect(places).toHaveLength(stretches.length);
    // Not always the same position, which would form lines.
    expect(new Set(places)).toEqual(new Set([0, 1, 2, 3, 4]));
    expect(counts.map((_, i) => thin.pointsOf(i))).toEqual([29, 29, 8, 1]);
    expect(counts.map((_, i) => thin.pointsCame(i))).toEqual(counts);
    expect(thin.cover(0) / whole.cover(0)).toBeCloseTo(Math.sqrt(5), 5);
  });

  it('abandons a batch that is not handed over', () => {
    const decoder = new Points64PacketDecoder(codec);
    const [block] = blocks([10]);
    const data = (block as { data: Uint8Array }).data;
    const header = { frameNumber: 7, frameLength: 80, sequenceOffset: 0, sequenceLength: 80 };
    decoder.add(header, placement, data, 5, writer(1));
    decoder.abandon();
    const into = writer(1);
    decoder.add(header, placement, data, 5, into);
    decoder.finish(into.batch);
    expect(into.batch.pointCount).toBe(10);
    const drops: string[] = [];
    const drop = (reason: string) => drops.push(reason);
    decoder.add(header, placement, data, 5, {
      every: 1,
      everySample: 1,
      surface: false,
      batchFor: () => null,
      drop,
    });
    expect(drops).toEqual(['no-buffer']);
  });
});
