import { emptyPlacement, encodeUnorganisedStream } from '@farpoint/protocol';
import { OrganisedEncoder, UnorganisedEncoder } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, it } from 'vitest';
import { BATCH_BYTES, BATCH_POINTS, Batch } from './batch.ts';
import { OrganisedPacketDecoder } from './organised-packet-decoder.ts';
import type { BatchWriter } from './packet-decoder.ts';
import type { DropReason } from './packet-intake.ts';
import { UnorganisedPacketDecoder } from './unorganised-packet-decoder.ts';

const codec = await loadCodecFromDisk();
const placement = emptyPlacement();

/** Batches as the worker fills them, at most `most`. */
class Batches implements BatchWriter {
  every = 1;
  readonly everySample = 1;
  surface = false;
  readonly all: Batch[] = [];
  readonly drops: DropReason[] = [];
  readonly #most: number;

  constructor(most = Number.POSITIVE_INFINITY) {
    this.#most = most;
  }

  batchFor(wanted: number): Batch | null {
    const last = this.all.at(-1);
    if (last !== undefined && !last.full && wanted <= last.room) return last;
    if (this.all.length >= this.#most) return null;
    const batch = new Batch(new ArrayBuffer(BATCH_BYTES));
    this.all.push(batch);
    return batch;
  }

  drop(reason: DropReason): void {
    this.drops.push(reason);
  }
}

const [WIDTH, HEIGHT] = [480, 480];
const CAMERA = { fx: 240, fy: 240, cx: 239.5, cy: 239.5 };
interface Packet {
  data: Uint8Array;
  header: { frameNumber: number; frameLength: number; sequenceOffset: number; sequenceLength: number };
}

/** Frames of a slanted wall with a hole; `depth` shifts it. */
function organisedFrames(frames: readonly { number: number; depth: number }[]): {
  header: Uint8Array;
  packets: Packet[][];
} {
  const encoder = new OrganisedEncoder(codec, { width: WIDTH, height: HEIGHT });
  let header: Uint8Array | null = null;
  const packets = frames.map(({ number: frameNumber, depth }) => {
    for (let i = 0; i < WIDTH * HEIGHT; i++) {
      const [u, v] = [i % WIDTH, Math.floor(i / WIDTH)];
      encoder.depth[i] = u > 300 && v > 400 ? 0 : depth + u / 200 + ((u * 7 + v * 13) % 5) / 500;
      encoder.colour[i] = 0xff00_0000 | ((u >> 1) << 8) | (v >> 1);
    }
    header ??= encoder.begin(CAMERA, { fromImages: true }).slice();
    const { points, packets: count } = encoder.encode({ fromImages: true });
    let sequenceOffset = 0;
    return Array.from({ length: count }, (_, i) => {
      const sequenceLength = (encoder.lengths[i * 2 + 1] as number) * 8;
      const frame = { frameNumber, frameLength: points * 8, sequenceOffset, sequenceLength };
      sequenceOffset += sequenceLength;
      return { data: encoder.packet(i).slice(), header: frame };
    });
  });
  return { header: header as unknown as Uint8Array, packets };
}

/** The value of a positive half float (IEEE 754 binary16) that is not subnormal. */
function half(bits: number): number {
  return 2 ** ((bits >> 10) - 15) * (1 + (bits & 1023) / 1024);
}

describe('OrganisedPacketDecoder', () => {
  const { header, packets } = organisedFrames([
    { number: 0xffff_ffff, depth: 1 },
    { number: 0, depth: 2 },
    { number: 1, depth: 3 },
  ]);
  const [first, second, third] = packets as [Packet[], Packet[], Packet[]];
  const add = (decoder: OrganisedPacketDecoder, packet: Packet, into: BatchWriter) =>
    decoder.add(packet.header, placement, packet.data, 5, into);

  it('hands on every point of every packet at its place in the frame', () => {
    const decoder = new OrganisedPacketDecoder(codec, header);
    const batches = new Batches();
    for (const packet of first) add(decoder, packet, batches);
    decoder.settle(batches);
    expect(batches.drops).toEqual([]);
    const total = (first[0] as Packet).header.frameLength / 8;
    expect(total).toBeGreaterThan(BATCH_POINTS * 3);
    expect(batches.all.reduce((sum, batch) => sum + batch.pointCount, 0)).toBe(total);
    let next = 0;
    for (const batch of batches.all) {
      let point = 0;
      for (let i = 0; i < batch.packets; i++) {
        expect(batch.sequenceOffset(i)).toBe(next);
        next += batch.sequenceLength(i);
        expect(batch.pointsOf(i)).toBe(batch.pointsCame(i));
        for (const end = point + batch.pointsOf(i); point < end; point++) {
          const [x, y, z] = batch.points.subarray(point * 4) as unknown as [number, number, number];
          const u = (x / z) * CAMERA.fx + CAMERA.cx;
          const v = (y / z) * CAMERA.fy + CAMERA.cy;
          if (Math.abs(u - Math.round(u)) > 0.26 || Math.abs(v - Math.round(v)) > 0.26 || z < 990 || z > 3500)
            expect.unreachable(`point ${point}: pixel ${u}, ${v}, ${z} mm`);
        }
      }
      // The camera's field of view: 90°, less half a pixel on each side.
      expect(batch.imageExtent(0)).toBeCloseTo(2, 2);
      expect(batch.unit(0)).toBeCloseTo(0.001, 9);
    }
    expect(next).toBe(total * 8);
  });

  it('keeps two frames open, since the last packets of one may come after the first of the next', () => {
    const decoder = new OrganisedPacketDecoder(codec, header);
    const batches = new Batches();
    const late = first.slice(-2);
    for (const packet of first.slice(0, -2)) add(decoder, packet, batches);
    add(decoder, second[0] as Packet, batches);
    for (const packet of late) add(decoder, packet, batches);
    for (const packet of second.slice(1)) add(decoder, packet, batches);
    decoder.settle(batches);
    expect(batches.drops).toEqual([]);
    // A duplicate is refused; a packet from two frames back is late.
    add(decoder, second[3] as Packet, batches);
    add(decoder, third[0] as Packet, batches);
    add(decoder, late[0] as Packet, batches);
    decoder.settle(batches);
    expect(batches.drops).toEqual(['duplicate', 'late']);
  });

  it('decodes two packets at once and hands each on with its own place, time and pose', () => {
    const decoder = new OrganisedPacketDecoder(codec, header);
    const batches = new Batches();
    const moved = emptyPlacement();
    // The page reads every packet's pose into the same object.
    for (const [i, packet] of first.slice(0, 3).entries()) {
      moved.pose.position.x = i;
      moved.pose.orientation.y = i / 4;
      moved.captureTimeUs = 100 + i;
      moved.latencyTest = i === 1;
      const passing = { ...packet.header };
      decoder.add(passing, moved, packet.data, 10 * i, batches);
      passing.sequenceOffset = 0;
    }
    const batch = batches.all[0] as Batch;
    // The third packet waits for a fourth.
    expect(batch.packets).toBe(2);
    decoder.settle(batches);
    decoder.settle(batches);
    expect(batch.packets).toBe(3);
    for (const [i, packet] of first.slice(0, 3).entries()) {
      expect(batch.sequenceOffset(i)).toBe(packet.header.sequenceOffset);
      expect(batch.receivedAtMs(i)).toBe(10 * i);
      expect(batch.captureTimeUs(i)).toBe(100 + i);
      expect(batch.isLatencyTest(i)).toBe(i === 1);
      expect([batch.poseComponent(i, 0), batch.poseComponent(i, 4)]).toEqual([i, i / 4]);
    }
    // A packet held from an ended session must not appear in the next.
    add(decoder, first[3] as Packet, batches);
    decoder.abandon();
    decoder.settle(batches);
    expect(batch.packets).toBe(3);
    expect(batches.drops).toEqual([]);
  });

  it('hands on fewer and larger points if not all can be drawn, at unchanged places in the frame', () => {
    const [whole, thin] = [new Batches(), new Batches()];
    thin.every = 8;
    for (const batches of [whole, thin]) {
      const decoder = new OrganisedPacketDecoder(codec, header);
      for (const packet of second) add(decoder, packet, batches);
      decoder.settle(batches);
      expect(batches.drops).toEqual([]);
    }
    const sum = (batches: Batches, of: (batch: Batch, packet: number) => number) =>
      batches.all
        .flatMap((batch) => Array.from({ length: batch.packets }, (_, i) => of(batch, i)))
        .reduce((a, b) => a + b, 0);
    expect(sum(thin, (batch, i) => batch.pointsCame(i))).toBe(sum(whole, (batch, i) => batch.pointsCame(i)));
    const drawn = sum(thin, (batch, i) => batch.pointsOf(i));
    expect(drawn / sum(whole, (batch, i) => batch.pointsOf(i))).toBeCloseTo(1 / 8, 2);
    const [a, b] = [whole.all[0] as Batch, thin.all[0] as Batch];
    expect(b.cover(0) / a.cover(0)).toBeCloseTo(Math.sqrt(8), 5);
    const point = (batch: Batch, i: number) => batch.points.subarray(i * 4, i * 4 + 4).join();
    for (let i = 0; i < Math.floor(a.pointsOf(0) / 8); i++) {
      expect(Array.from({ length: 8 }, (_, k) => point(a, i * 8 + k))).toContain(point(b, i));
    }
  });

  it('hands tiles on from the next frame after a surface is wanted: every tile once, each sample in its place', () => {
    const decoder = new OrganisedPacketDecoder(codec, header);
    const batches = new Batches();
    add(decoder, first[0] as Packet, batches);
    batches.surface = true;
    add(decoder, first[1] as Packet, batches);
    decoder.settle(batches);
    expect(batches.all[0]?.tilesOf(1)).toBe(0);
    const tiled = new Batches();
    tiled.surface = true;
    for (const packet of second) add(decoder, packet, tiled);
    decoder.settle(tiled);
    expect(tiled.drops).toEqual([]);
    const grid = { width: 0, height: 0, fx: 0, fy: 0, cx: 0, cy: 0 };
    const seen = new Set<number>();
    let points = 0;
    for (const batch of tiled.all) {
      let at = 0;
      for (let packet = 0; packet < batch.packets; packet++) {
        batch.readGrid(packet, grid);
        expect(grid).toEqual({ width: WIDTH, height: HEIGHT, ...CAMERA });
        points += batch.pointsCame(packet);
        for (let i = 0; i < batch.tilesOf(packet); i++) {
          const tile = batch.firstTile(packet) + i;
          expect(seen.has(tile)).toBe(false);
          seen.add(tile);
          const [u, v] = [(tile % 30) * 16 + 5, Math.floor(tile / 30) * 16 + 9];
          const sample = batch.samples[at * 2 + 256 * i + 9 * 16 + 5] as number;
          const inverse = half(sample & 0xffff);
          if (u > 300 && v > 400) expect(sample).toBe(0);
          else expect(1 / inverse).toBeCloseTo(2 + u / 200 + ((u * 7 + v * 13) % 5) / 500, 1);
        }
        at += batch.pointsOf(packet);
      }
      expect(at).toBe(batch.pointCount);
    }
    // Tiles of the hole need not be sent.
    for (let tile = 0; tile < 900; tile++) {
      if (tile % 30 < 19 || tile < 750) expect(seen.has(tile)).toBe(true);
    }
    expect(points * 8).toBe((second[0] as Packet).header.frameLength);
  });

  it('refuses a wrong count and foreign bytes, and reports a missing buffer', () => {
    const decoder = new OrganisedPacketDecoder(codec, header);
    const batches = new Batches();
    const packet = first[0] as Packet;
    const wrong = { ...packet.header, sequenceLength: packet.header.sequenceLength + 8 };
    decoder.add(wrong, placement, packet.data, 0, batches);
    const damaged = (first[1] as Packet).data.slice();
    damaged[20] = (damaged[20] as number) ^ 1;
    add(decoder, { ...(first[1] as Packet), data: damaged }, batches);
    // If one of two packets is refused, the other is still decoded.
    add(decoder, { ...(first[1] as Packet), data: damaged }, batches);
    add(decoder, first[2] as Packet, batches);
    expect(batches.drops).toEqual(['bad-count', 'bad-check', 'bad-check']);
    expect(batches.all[0]?.packets).toBe(1);
    expect(batches.all[0]?.sequenceOffset(0)).toBe(first[2]?.header.sequenceOffset);
    const none = new Batches(0);
    add(decoder, first[3] as Packet, none);
    decoder.settle(none);
    expect(none.drops).toEqual(['no-buffer']);
    expect(() => new OrganisedPacketDecoder(codec, header.slice(1))).toThrow();
  });
});

describe('UnorganisedPacketDecoder', () => {
  it('converts packets into the stream’s unit, far points too', () => {
    const encoder = new UnorganisedEncoder(codec, 3000);
    for (let i = 0; i < 3000; i++) {
      const [angle, range] = [i / 40, 2 + ((i * 37) % 100)];
      encoder.frame.set([Math.cos(angle) * range, Math.sin(angle) * range, ((i % 16) - 8) / 4], i * 4);
      encoder.frameBits[i * 4 + 3] = 0xff80_4020;
    }
    const { packets, kept } = encoder.encode({ points: 3000, attribute: 'colour' });
    expect(kept).toBe(3000);
    const decoder = new UnorganisedPacketDecoder(codec, encodeUnorganisedStream({ unitMm: 4 }));
    const batches = new Batches();
    let sequenceOffset = 0;
    for (let i = 0; i < packets; i++) {
      const sequenceLength = encoder.pointsOf(i) * 8;
      const header = { frameNumber: 1, frameLength: kept * 8, sequenceOffset, sequenceLength };
      decoder.add(header, placement, encoder.packet(i).slice(), 0, batches);
      sequenceOffset += sequenceLength;
    }
    expect(batches.drops).toEqual([]);
    const [batch] = batches.all as [Batch];
    expect(batch.pointCount).toBe(3000);
    expect(batch.unit(0)).toBeCloseTo(0.004, 9);
    const ranges = Array.from({ length: 3000 }, (_, i) => {
      const [x, y] = batch.points.subarray(i * 4) as unknown as [number, number];
      return Math.hypot(x, y) * 0.004;
    }).sort((a, b) => a - b);
    const expected = Array.from({ length: 3000 }, (_, i) => 2 + ((i * 37) % 100)).sort((a, b) => a - b);
    // Half a step of 10 mm and half a unit of 4 mm, on two axes.
    for (const [i, range] of ranges.entries())
      expect(Math.abs(range - (expected[i] as number))).toBeLessThan(0.01);
  });

  it('refuses an invalid header', () => {
    expect(() => new UnorganisedPacketDecoder(codec, new Uint8Array(8))).toThrow(/FPUC/);
  });
});
