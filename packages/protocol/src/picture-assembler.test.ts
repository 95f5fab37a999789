import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { PictureAssembler, type WholePicture } from './picture-assembler.ts';
import { type PictureHeader, pictureChunks, writePictureChunk } from './picture-chunk.ts';

const bytesOf = (length: number, seed: number) =>
  Uint8Array.from({ length }, (_, i) => (i * 31 + seed * 7) & 0xff);

function chunksOf(pictureId: number, length: number, more: Partial<PictureHeader> = {}): Uint8Array[] {
  const header: PictureHeader = {
    ...{ format: 'jpeg', camera: 0, width: 640, height: 480, captureTimeUs: pictureId * 10 },
    ...{ pictureId: pictureId >>> 0, ...more },
  };
  const picture = bytesOf(length, pictureId);
  return Array.from({ length: pictureChunks(length) }, (_, index) => {
    const room = new Uint8Array(1200);
    return room.subarray(0, writePictureChunk(header, picture, index, room));
  });
}

function assembler(cameras = 2): PictureAssembler {
  const made = new PictureAssembler();
  made.cameras = cameras;
  return made;
}

const feed = (into: PictureAssembler, chunks: readonly Uint8Array[]): WholePicture[] =>
  chunks.flatMap((chunk) => into.take(chunk) ?? []);

describe('PictureAssembler', () => {
  it('returns a picture unchanged, whatever the order of its chunks', () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 1, max: 9000 }).chain((length) =>
          fc.tuple(
            fc.constant(length),
            fc.shuffledSubarray([...Array(pictureChunks(length)).keys()], {
              minLength: pictureChunks(length),
            }),
          ),
        ),
        ([length, order]) => {
          const chunks = chunksOf(5, length);
          const [picture, ...others] = feed(
            assembler(),
            order.map((index) => chunks[index] as Uint8Array),
          );
          expect(others).toEqual([]);
          expect(picture).toMatchObject({ pictureId: 5, width: 640, height: 480, captureTimeUs: 50 });
          expect(picture?.bytes).toEqual(bytesOf(length, 5));
        },
      ),
      { seed: 1, numRuns: 200 },
    );
  });

  it('the newest picture wins: older ones are no longer returned, incomplete ones are counted', () => {
    const into = assembler();
    const [first, second] = [chunksOf(1, 2000), chunksOf(2, 2000)];
    expect(feed(into, [first[0] as Uint8Array, ...second]).map(({ pictureId }) => pictureId)).toEqual([2]);
    expect(feed(into, [first[1] as Uint8Array])).toEqual([]);
    expect(Object.fromEntries(into.drops)).toEqual({ superseded: 1, late: 1 });
  });

  it('holds two unfinished pictures per camera; a third replaces the oldest', () => {
    const into = assembler();
    const [a, b, c] = [1, 2, 3].map((id) => chunksOf(id, 2000)) as [Uint8Array[], Uint8Array[], Uint8Array[]];
    feed(into, [a[0], b[0], c[0]] as Uint8Array[]);
    expect(feed(into, [a[1], b[1], c[1]] as Uint8Array[]).map(({ pictureId }) => pictureId)).toEqual([2, 3]);
    expect(Object.fromEntries(into.drops)).toEqual({ superseded: 1, late: 1 });
  });

  it('continues when the numbers wrap', () => {
    const into = assembler();
    const ids = [0xffffffff, 0, 1];
    expect(ids.flatMap((id) => feed(into, chunksOf(id, 10))).map(({ pictureId }) => pictureId)).toEqual(ids);
  });

  it('keeps cameras apart, and knows only those that were announced', () => {
    const into = assembler(2);
    const all = [0, 1, 2].flatMap((camera) => feed(into, chunksOf(1, 10, { camera })));
    expect(all.map(({ camera }) => camera)).toEqual([0, 1]);
    expect(into.drops.get('unknown-camera')).toBe(1);
  });

  it('refuses chunks that contradict earlier ones, and repeated ones', () => {
    const into = assembler();
    const whole = chunksOf(1, 3000);
    feed(into, [whole[0] as Uint8Array, whole[0] as Uint8Array]);
    feed(into, [chunksOf(1, 3000, { width: 641 })[1] as Uint8Array, chunksOf(1, 5000)[1] as Uint8Array]);
    expect(Object.fromEntries(into.drops)).toEqual({ duplicate: 1, inconsistent: 2 });
    expect(feed(into, whole.slice(1))).toHaveLength(1);
  });

  it('accepts any input, and returns only pictures made of their own bytes', () => {
    const some = fc.record({
      camera: fc.nat(3),
      id: fc.nat(6),
      length: fc.constantFrom(1, 1140, 1141, 3000),
      cut: fc.nat(4),
      change: fc.option(fc.tuple(fc.nat(19), fc.nat(255))),
    });
    let whole = 0;
    fc.assert(
      fc.property(fc.array(some, { maxLength: 60 }), (steps) => {
        const into = assembler(3);
        for (const { camera, id, length, cut, change } of steps) {
          const chunks = chunksOf(id, length, { camera });
          const chunk = (chunks[cut % chunks.length] as Uint8Array).slice();
          if (change !== null) chunk[change[0]] = change[1];
          const picture = into.take(chunk);
          if (picture === null) continue;
          whole++;
          expect(picture.bytes.length).toBeGreaterThan(0);
          expect(picture.bytes.length).toBeLessThanOrEqual(512 * 1140);
        }
      }),
      { seed: 3, numRuns: 500 },
    );
    expect(whole).toBeGreaterThan(100);
  });
});
