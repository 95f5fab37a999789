import fc from 'fast-check';
import { describe, expect, it, test } from 'vitest';
import { BARCODE_HEIGHT, BARCODE_WIDTH, drawBarcode } from './latency-barcode.ts';
import { type BarcodeFault, readBarcode } from './latency-barcode-reader.ts';
import { blurred, changed, fillRectangle, generator, rgbaOf } from './testing/pictures.ts';
import { readVectors } from './testing/vectors.ts';

interface Squares {
  name: string;
  squares: string[];
}
const vectors = readVectors<{
  draw: (Squares & { hi: number; lo: number })[];
  read: (Squares & { black: number; white: number; hi?: number; lo?: number; fault?: BarcodeFault })[];
}>('latency-barcode');

const WIDTH = 160;
const HEIGHT = 64;
const HI = 0x18ea9a68;
const LO = 0x24439515;
const READ = { time: { hi: HI, lo: LO }, fault: null };

function drawn(hi = HI, lo = LO): Uint8Array {
  const luma = new Uint8Array(WIDTH * HEIGHT).fill(77);
  drawBarcode(luma, WIDTH, hi, lo);
  return luma;
}

function read(luma: Uint8Array) {
  return readBarcode(luma, WIDTH, HEIGHT, WIDTH, 1);
}

describe('conformance vectors', () => {
  test.each(vectors.draw)('draw: $name', ({ hi, lo, squares }) => {
    const luma = drawn(hi, lo);
    for (let y = 0; y < HEIGHT; y++) {
      for (let x = 0; x < WIDTH; x++) {
        const square = squares[y >> 3]?.[x >> 3];
        const expected = square === undefined ? 77 : square === '1' ? 235 : 16;
        if (luma[y * WIDTH + x] !== expected) expect.fail(`pixel ${x}, ${y}`);
      }
    }
    expect(read(luma)).toEqual({ time: { hi, lo }, fault: null });
  });

  test.each(vectors.read)('read: $name', ({ squares, black, white, hi, lo, fault }) => {
    const luma = new Uint8Array(BARCODE_WIDTH * BARCODE_HEIGHT).map((_, i) => {
      const x = i % BARCODE_WIDTH;
      return squares[((i - x) / BARCODE_WIDTH) >> 3]![x >> 3] === '1' ? white : black;
    });
    const reading = readBarcode(luma, BARCODE_WIDTH, BARCODE_HEIGHT, BARCODE_WIDTH, 1);
    expect(reading).toEqual(fault === undefined ? { time: { hi, lo }, fault: null } : { time: null, fault });
  });
});

const u32 = fc.oneof(fc.nat(0xffff_ffff), fc.constantFrom(0, 1, 0x8000_0000, 0xffff_ffff));

test('any time comes back, from luma, RGB and RGBA', () => {
  fc.assert(
    fc.property(u32, u32, (hi, lo) => {
      const luma = drawn(hi, lo);
      expect(read(luma)).toEqual({ time: { hi, lo }, fault: null });
      const rgb = new Uint8Array(luma.length * 3).map((_, i) => luma[Math.floor(i / 3)] as number);
      expect(readBarcode(rgb, WIDTH, HEIGHT, 3 * WIDTH, 3).time).toEqual({ hi, lo });
      const rgba = rgbaOf(luma, 128, 128);
      expect(readBarcode(rgba, WIDTH, HEIGHT, 4 * WIDTH, 4).time).toEqual({ hi, lo });
    }),
    { seed: 1, numRuns: 60 },
  );
});

test('any time comes back through noise, blur, brightness, contrast and a shift by a pixel', () => {
  const harm = fc.record({
    seed: fc.nat(0xffff_ffff),
    noise: fc.nat(40),
    isBlurred: fc.boolean(),
    gain: fc.constantFrom(0.6, 0.8, 1, 1.3),
    offset: fc.integer({ min: -15, max: 60 }),
    shift: fc.constantFrom(0, 0, 1),
  });
  fc.assert(
    fc.property(u32, u32, harm, (hi, lo, { seed, noise, isBlurred, gain, offset, shift }) => {
      const next = generator(seed);
      const shifted = drawn(hi, lo).map((_, i, luma) => luma[i - shift * (WIDTH + 1)] ?? 77);
      const soft = isBlurred ? blurred(shifted, WIDTH) : shifted;
      const luma = changed(soft, (value) => value * gain + offset + next(2 * noise + 1) - noise);
      expect(read(luma)).toEqual({ time: { hi, lo }, fault: null });
    }),
    { seed: 2, numRuns: 150 },
  );
});

test('colours under the squares do not matter, unless they are garish', () => {
  for (const cb of [90, 128, 166]) {
    for (const cr of [90, 128, 166]) {
      expect(readBarcode(rgbaOf(drawn(), cb, cr), WIDTH, HEIGHT, 4 * WIDTH, 4)).toEqual(READ);
    }
  }
});

test('one to three wrong squares, or any within 16 of each other, are always noticed', () => {
  const position = fc.nat(79);
  const few = fc.uniqueArray(position, { minLength: 1, maxLength: 3 });
  const burst = fc
    .tuple(fc.nat(64), fc.uniqueArray(fc.nat(15), { minLength: 1 }))
    .map(([from, offsets]) => offsets.map((offset) => from + offset));
  fc.assert(
    fc.property(u32, u32, fc.oneof(few, burst), (hi, lo, wrong) => {
      const luma = drawn(hi, lo);
      for (const at of wrong) {
        const [x, y] = [8 + (at % 16) * 8, 8 + (at >> 4) * 8];
        fillRectangle(luma, WIDTH, [x, y, 8, 8], luma[y * WIDTH + x] === 16 ? 235 : 16);
      }
      expect(read(luma)).toEqual({ time: null, fault: 'bad-checksum' });
    }),
    { seed: 3, numRuns: 500 },
  );
});

test('a grey square is unclear, and a picture that something covers has no barcode', () => {
  // One of them would read right.
  for (const value of [124, 127]) {
    const grey = drawn();
    fillRectangle(grey, WIDTH, [40, 24, 8, 8], value);
    expect(read(grey)).toEqual({ time: null, fault: 'unclear' });
  }
  for (const covered of [
    [0, 50, WIDTH, 14],
    [138, 0, 22, HEIGHT],
    [0, 0, 60, 5],
  ] as const) {
    const luma = drawn();
    fillRectangle(luma, WIDTH, covered, 77);
    expect(read(luma)).toEqual({ time: null, fault: 'no-barcode' });
  }
});

test('a picture that is cut off is too small, whatever it claims', () => {
  const tooSmall = { time: null, fault: 'too-small' };
  const luma = drawn();
  const enough = (BARCODE_HEIGHT - 1) * WIDTH + BARCODE_WIDTH;
  const cut = luma.subarray(0, enough);
  expect(readBarcode(cut, WIDTH, BARCODE_HEIGHT, WIDTH, 1)).toEqual(READ);
  expect(readBarcode(luma.subarray(0, enough - 1), WIDTH, HEIGHT, WIDTH, 1)).toEqual(tooSmall);
  expect(readBarcode(luma, BARCODE_WIDTH - 1, HEIGHT, WIDTH, 1)).toEqual(tooSmall);
  expect(readBarcode(luma, WIDTH, BARCODE_HEIGHT - 1, WIDTH, 1)).toEqual(tooSmall);
  expect(readBarcode(luma, WIDTH, HEIGHT, BARCODE_WIDTH - 1, 1)).toEqual(tooSmall);
  expect(readBarcode(luma, WIDTH, HEIGHT, WIDTH, 4)).toEqual(tooSmall);
  expect(readBarcode(luma, Number.NaN, Number.NaN, Number.NaN, 1)).toEqual(tooSmall);
});

it('is not drawn where there is no room', () => {
  const enough = (BARCODE_HEIGHT - 1) * WIDTH + BARCODE_WIDTH;
  expect(() => drawBarcode(new Uint8Array(enough), WIDTH, 1, 2)).not.toThrow();
  expect(() => drawBarcode(new Uint8Array(enough - 1), WIDTH, 1, 2)).toThrow(RangeError);
  expect(() => drawBarcode(new Uint8Array(99_999), BARCODE_WIDTH - 1, 1, 2)).toThrow(RangeError);
});
