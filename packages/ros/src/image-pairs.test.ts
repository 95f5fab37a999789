import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type ImagePair, ImagePairs } from './image-pairs.ts';

interface Picture {
  stampNs: bigint;
  kind: 'depth' | 'colour';
}
const at = (kind: Picture['kind'], ms: number): Picture => ({ kind, stampNs: BigInt(Math.round(ms * 1e6)) });
const ms = (picture: Picture | null) => (picture === null ? null : Number(picture.stampNs) / 1e6);

/** Feeds images in the given order. @returns the pairs as ms, and which images were released */
function feed(pictures: readonly Picture[]) {
  const released: Picture[] = [];
  const pairs: [number | null, number | null][] = [];
  const under = new ImagePairs<Picture>((picture) => released.push(picture));
  for (const picture of pictures) {
    const pair: ImagePair<Picture> | null =
      picture.kind === 'depth' ? under.depth(picture) : under.colour(picture);
    if (pair !== null) pairs.push([ms(pair.depth), ms(pair.colour)]);
  }
  return { pairs, released };
}

describe('ImagePairs', () => {
  it('pairs equal stamps at once, whichever comes first', () => {
    const { pairs } = feed([
      ...[at('depth', 0), at('colour', 0)],
      ...[at('colour', 33), at('depth', 33)],
      ...[at('depth', 66), at('colour', 66.5)],
    ]);
    expect(pairs).toEqual([
      [0, 0],
      [33, 33],
      [66, 66.5],
    ]);
  });

  it('for unsynchronised cameras, takes the nearest colour image once a later one is there', () => {
    const { pairs } = feed([
      ...[at('colour', 10), at('depth', 20), at('colour', 43), at('depth', 53)],
      ...[at('colour', 76), at('depth', 86), at('colour', 109)],
    ]);
    expect(pairs).toEqual([
      [20, 10],
      [53, 43],
      [86, 76],
    ]);
  });

  it('shows depth even if colour is slow or gone', () => {
    const slow = [at('colour', 0), at('depth', 30), at('depth', 60), at('depth', 90)];
    expect(feed(slow).pairs).toEqual([
      [30, 0],
      [60, 0],
    ]);
    const gone = [at('colour', 0), ...Array.from({ length: 50 }, (_, i) => at('depth', 200 + i * 33))];
    const { pairs } = feed(gone);
    expect(pairs.length).toBeGreaterThan(20);
    expect(pairs.every(([, colour]) => colour === null)).toBe(true);
  });

  it('never keeps more than a few images, and shows or releases each depth image once', () => {
    const picture = fc.tuple(
      fc.constantFrom('depth' as const, 'colour' as const),
      fc.integer({ min: 0, max: 60 }),
    );
    fc.assert(
      fc.property(fc.array(picture, { maxLength: 80 }), (steps) => {
        let time = 0;
        const pictures = steps.map(([kind, step]) => {
          time += step;
          return at(kind, time);
        });
        const { pairs, released } = feed(pictures);
        const depths = pictures.filter(({ kind }) => kind === 'depth').length;
        const done = pairs.length + released.filter(({ kind }) => kind === 'depth').length;
        expect(depths - done).toBeLessThanOrEqual(1);
        const colours = pictures.length - depths;
        expect(colours - released.filter(({ kind }) => kind === 'colour').length).toBeLessThanOrEqual(3);
        for (const [depth, colour] of pairs) {
          if (depth !== null && colour !== null) expect(Math.abs(depth - colour)).toBeLessThanOrEqual(100);
        }
      }),
    );
  });
});
