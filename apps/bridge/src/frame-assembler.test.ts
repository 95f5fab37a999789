import { writePointPacketHeader } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type AssembledFrame, FrameAssembler } from './frame-assembler.ts';

const BLOCK = 150;

/** Points whose coordinates say which frame and place they belong to. */
function packet(frameNumber: number, total: number, first: number, padded = true): Uint8Array {
  const count = Math.min(BLOCK, total - first);
  const bytes = new Uint8Array(padded ? 1216 : 16 + 8 * count + 28);
  const view = new DataView(bytes.buffer);
  writePointPacketHeader(view, 0, {
    frameNumber,
    frameLength: total * 8,
    sequenceOffset: first * 8,
    sequenceLength: count * 8,
  });
  for (let i = 0; i < count; i++) {
    view.setInt16(16 + 6 * i, frameNumber & 0x7fff, true);
    view.setInt16(18 + 6 * i, first + i, true);
    view.setUint16(16 + 6 * count + 2 * i, (first + i) ^ 0x5555, true);
  }
  return bytes;
}

function packetsOf(frameNumber: number, total: number): Uint8Array[] {
  return Array.from({ length: Math.ceil(total / BLOCK) }, (_, i) => packet(frameNumber, total, i * BLOCK));
}

/** The places of a frame's points, after checking that each carries the right frame and colour. */
function placesOf(frame: AssembledFrame): number[] {
  const { bytes, points } = frame;
  expect(bytes.byteLength).toBe(points * 8);
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const strays: number[] = [];
  const places = Array.from({ length: points }, (_, i) => {
    const place = view.getInt16(6 * i + 2, true);
    const isOwn = view.getInt16(6 * i, true) === (frame.frameNumber & 0x7fff);
    if (!isOwn || view.getUint16(6 * points + 2 * i, true) !== (place ^ 0x5555)) strays.push(i);
    return place;
  });
  expect(strays).toEqual([]);
  return places;
}

function assembler(reorderMs = 20, maxPoints = 10_000) {
  const frames: AssembledFrame[] = [];
  const made = new FrameAssembler({ maxPoints, reorderMs }, (frame) => frames.push(frame));
  return { made, frames };
}

describe('FrameAssembler', () => {
  it('emits a frame at the packet that completes it, even if that is the frame’s first packet', () => {
    const { made, frames } = assembler();
    const [a, b, c] = packetsOf(7, 400) as [Uint8Array, Uint8Array, Uint8Array];
    made.accept(c, 0);
    made.accept(b, 1);
    expect(frames).toEqual([]);
    made.accept(a, 2);
    expect(frames.map(placesOf)).toEqual([Array.from({ length: 400 }, (_, i) => i)]);
    expect(made.accept(a, 3)).toBe('late');
  });

  it('emits an incomplete frame some time after its end was seen, without the next frame', () => {
    const { made, frames } = assembler(20);
    const [a, , c] = packetsOf(0, 400) as [Uint8Array, Uint8Array, Uint8Array];
    made.accept(a, 0);
    expect(made.nextDueMs).toBeNull();
    made.accept(c, 5);
    expect(made.nextDueMs).toBe(25);
    made.expire(24.9);
    expect(frames).toEqual([]);
    made.expire(25);
    expect(frames.map(({ points, expectedPoints }) => [points, expectedPoints])).toEqual([[250, 400]]);
    expect(placesOf(frames[0] as AssembledFrame)).toEqual([
      ...Array(150).keys(),
      ...Array.from({ length: 100 }, (_, i) => 300 + i),
    ]);
    expect(made.nextDueMs).toBeNull();
  });

  it('lets a complete later frame overtake immediately, and keeps the order', () => {
    const { made, frames } = assembler();
    made.accept(packet(3, 400, 0), 0);
    for (const later of packetsOf(4, 300)) made.accept(later, 1);
    expect(frames.map(({ frameNumber, points }) => [frameNumber, points])).toEqual([
      [3, 150],
      [4, 300],
    ]);
  });

  it('follows a counter that wraps, and one that restarts', () => {
    const { made, frames } = assembler();
    for (const number of [0xffffffff, 0, 1]) made.accept(packet(number, 10, 0, false), 0);
    for (const number of [5000, 0]) made.accept(packet(number, 10, 0), 0);
    expect(frames.map((frame) => frame.frameNumber)).toEqual([0xffffffff, 0, 1, 5000, 0]);
  });

  it('keeps the frame when a packet contradicts it', () => {
    const { made, frames } = assembler();
    made.accept(packet(1, 300, 0), 0);
    expect(made.accept(packet(1, 450, 150), 0)).toBe('inconsistent');
    expect(made.accept(packet(1, 300, 75), 0)).toBe('duplicate');
    expect(made.accept(packet(2, 20_000, 0), 0)).toBe('too-many-points');
    made.accept(packet(1, 300, 150), 0);
    expect(frames.map(placesOf)).toEqual([[...Array(300).keys()]]);
  });

  it('with 2 % lost, 5 % reordered and 5 % duplicated: emits every received point once, in its frame and place', () => {
    fc.assert(
      fc.property(
        fc.array(fc.nat(99), { minLength: 400, maxLength: 400 }),
        fc.integer({ min: 1, max: 6 }),
        (dice, by) => {
          const sent = Array.from({ length: 10 }, (_, n) => packetsOf(n, 2900)).flat();
          const wire = sent.flatMap((bytes, i) => {
            const die = dice[i] as number;
            if (die < 2) return [];
            const at = i + (die < 7 ? by + 0.5 : 0);
            return die >= 95
              ? [
                  { at, bytes },
                  { at: i + by, bytes },
                ]
              : [{ at, bytes }];
          });
          wire.sort((a, b) => a.at - b.at);
          const { made, frames } = assembler(20);
          const received = new Set<string>();
          for (const { at, bytes } of wire) {
            made.expire(at);
            made.accept(bytes, at);
            const view = new DataView(bytes.buffer);
            received.add(`${view.getUint32(0, true)}:${view.getUint32(8, true)}`);
          }
          made.expire(1e9);
          // If the last frame's last packet is lost, nothing marks its end.
          for (const bytes of packetsOf(10, 150)) made.accept(bytes, 1e9);
          const given = frames.filter((frame) => frame.frameNumber < 10);
          const places = given.map(placesOf);
          for (const list of places) expect(new Set(list).size).toBe(list.length);
          const points = places.reduce((sum, list) => sum + list.length, 0);
          const expected = [...received].reduce(
            (sum, key) => sum + (key.endsWith(`:${19 * 1200}`) ? 50 : 150),
            0,
          );
          expect(points).toBe(expected);
          expect(Object.keys(made.drops).filter((drop) => drop !== 'duplicate' && drop !== 'late')).toEqual(
            [],
          );
        },
      ),
      { seed: 1, numRuns: 60 },
    );
  });

  it('accepts any bytes', () => {
    fc.assert(
      fc.property(fc.array(fc.uint8Array({ maxLength: 1300 }), { maxLength: 30 }), (packets) => {
        const { made } = assembler();
        for (const [i, bytes] of packets.entries()) made.accept(bytes, i);
        made.expire(1e9);
      }),
      { seed: 2 },
    );
  });
});
