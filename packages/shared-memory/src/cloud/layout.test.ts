import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { SharedMemoryError } from '../errors.ts';
import { errorOf, fromHex, readVectors, toHex } from '../testing/helpers.ts';
import {
  type CloudFormat,
  type CloudHeader,
  colourOffset,
  completeLock,
  type FrameHeader,
  HEADER_BYTES,
  makeHeader,
  parseFrameHeader,
  parseHeader,
  payloadBytes,
  SLOT_HEADER_BYTES,
  writeFrameHeader,
  writeHeader,
  writingLock,
} from './layout.ts';

interface Vectors {
  headers: {
    name: string;
    hex: string;
    size: number;
    header?: CloudHeader;
    error?: string;
    offset?: number;
  }[];
  frames: {
    name: string;
    format: CloudFormat;
    maxPoints: number;
    hex: string;
    frame?: FrameHeader;
    error?: string;
    offset?: number;
  }[];
  payloads: { format: CloudFormat; points: number; bytes: number; colourOffset: number }[];
}
const vectors = readVectors<Vectors>('cloud.json');

function page(start: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(HEADER_BYTES);
  bytes.set(start);
  return bytes;
}

describe('cloud layout', () => {
  it.each(vectors.headers)('header: $name', ({ hex, size, header, error, offset }) => {
    const bytes = page(fromHex(hex)).subarray(0, Math.min(size, HEADER_BYTES));
    if (header === undefined) {
      expect(errorOf(() => parseHeader(bytes, size, 'f'))).toMatchObject({ code: error, offset, file: 'f' });
      return;
    }
    expect(parseHeader(bytes, size, 'f')).toEqual(header);
    expect(makeHeader(header)).toEqual(header);
    const written = new Uint8Array(HEADER_BYTES);
    writeHeader(written, header);
    expect(toHex(written.subarray(0, 64))).toBe(hex);
  });

  it.each(vectors.frames)('frame: $name', ({ format, maxPoints, hex, frame, error, offset = 0 }) => {
    const header = makeHeader({ format, maxPoints });
    const bytes = fromHex(hex);
    const parse = () => parseFrameHeader(bytes, header, 'f', 8192);
    if (frame === undefined) {
      expect(errorOf(parse)).toMatchObject({ code: error, offset: 8192 + offset });
      return;
    }
    expect(parse()).toEqual(frame);
    const written = bytes.slice();
    written.fill(0, 4);
    writeFrameHeader(written, new DataView(bytes.buffer).getUint32(4, true), frame);
    expect(toHex(written)).toBe(hex);
  });

  it.each(vectors.payloads)('payload: $points $format', ({ format, points, bytes, colourOffset: at }) => {
    expect(payloadBytes(format, points)).toBe(bytes);
    if (format !== 'points') expect(colourOffset(format, points)).toBe(at);
  });

  it('accepts nothing impossible, whatever the bytes', () => {
    const good = new Uint8Array(HEADER_BYTES);
    const header = makeHeader({ format: 'depth16', maxPoints: 100 });
    writeHeader(good, header);
    const frame = new Uint8Array(SLOT_HEADER_BYTES);
    const lens = { fx: 1, fy: 1, cx: 0, cy: 0 };
    writeFrameHeader(frame, 1, {
      ...{ capturedAtMs: 1, width: 10, height: 10, pose: null, lens, latencyTest: false, depthUnit: 0.001 },
    });
    const edits = (most: number) =>
      fc.array(fc.tuple(fc.nat({ max: most - 1 }), fc.nat({ max: 255 })), { maxLength: 6 });
    fc.assert(
      fc.property(edits(40), edits(128), fc.nat({ max: 100_000 }), (headerEdits, frameEdits, size) => {
        const a = good.slice();
        for (const [at, value] of headerEdits) a[at] = value;
        const b = frame.slice();
        for (const [at, value] of frameEdits) b[at] = value;
        try {
          const parsed = parseHeader(a, size, 'f');
          expect(HEADER_BYTES + parsed.slots * parsed.slotBytes).toBe(size);
        } catch (error) {
          expect(error).toBeInstanceOf(SharedMemoryError);
        }
        try {
          const { width, height } = parseFrameHeader(b, header, 'f', 0);
          expect(width * height).toBeLessThanOrEqual(header.maxPoints);
        } catch (error) {
          expect(error).toBeInstanceOf(SharedMemoryError);
        }
      }),
      { numRuns: 1000, seed: 1 },
    );
  });
});

describe('the lock of a slot', () => {
  it.each([
    [1, 1, 2],
    [2, 3, 4],
    [0x8000_0000, 0xffff_ffff, 0],
    [0xffff_ffff, 0xffff_fffd, 0xffff_fffe],
  ])('of frame %i is %i while it is written and %i after', (frame, writing, complete) => {
    expect([writingLock(frame), completeLock(frame)]).toEqual([writing, complete]);
  });
});
