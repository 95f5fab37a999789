/** Encoded pictures for tests: valid as far as RTP payload formats look, not decodable. */
import fc from 'fast-check';

/** Like an encoder's output: no start code inside, no zero at the end (ITU-T H.264 §7.4.1). */
export function nalUnit(header: number, body: Uint8Array): Uint8Array {
  const unit = new Uint8Array(1 + body.length);
  unit[0] = header;
  for (const [i, byte] of body.entries()) {
    const mayBeZero = unit[i] !== 0 && i < body.length - 1;
    unit[i + 1] = byte === 0 && !mayBeZero ? 0xff : byte;
  }
  return unit;
}

/** @param startCodeBytes length of each start code, 3 or 4; the last one counts for all that follow */
export function annexB(units: readonly Uint8Array[], startCodeBytes: readonly number[] = [4]): Uint8Array {
  const parts = units.flatMap((unit, i) => {
    const zeros = (startCodeBytes[i] ?? (startCodeBytes.at(-1) as number)) - 1;
    return [new Uint8Array(zeros), Uint8Array.of(1), unit];
  });
  return new Uint8Array(Buffer.concat(parts));
}

/** A slice of an IDR picture (0x65) or of another one (0x41); its body begins with first_mb_in_slice 0. */
export function slice(isKeyFrame: boolean, bodyBytes: number, fill = 0x5a): Uint8Array {
  const body = new Uint8Array(bodyBytes).fill(fill);
  body[0] = 0x88;
  return nalUnit(isKeyFrame ? 0x65 : 0x41, body);
}

export const SPS = Uint8Array.of(0x67, 0x42, 0xc0, 0x1f, 0xd9);
export const PPS = Uint8Array.of(0x68, 0xce, 0x3c, 0x80);

/** NAL units of any type whose lengths are around `limit`. */
export function anyUnits(limit: number): fc.Arbitrary<Uint8Array[]> {
  const header = fc.constantFrom(0x09, 0x67, 0x27, 0x68, 0x06, 0x65, 0x41, 0x01, 0x0c);
  const bytes = fc.oneof(
    fc.integer({ min: 1, max: 20 }),
    fc.integer({ min: Math.max(1, limit - 4), max: limit + 4 }),
    fc.integer({ min: Math.max(1, 2 * limit - 8), max: 3 * limit }),
  );
  const unit = fc.tuple(header, bytes, fc.nat(255)).map(([first, length, start]) =>
    nalUnit(
      first,
      new Uint8Array(length).map((_, i) => (start + i * 7) & (i % 5 === 0 ? 0 : 0xff)),
    ),
  );
  return fc.array(unit, { minLength: 1, maxLength: 8 });
}

/** A VP8 frame of this size in pixels, or an interframe. Its first partition ends with it. */
export function vp8Frame(size: { width: number; height: number } | null, partitionBytes: number): Uint8Array {
  const header = size === null ? 3 : 10;
  const frame = new Uint8Array(header + partitionBytes).map((_, i) => i * 11);
  const tag = (size === null ? 1 : 0) | 0x10 | (partitionBytes << 5);
  frame.set([tag, tag >> 8, tag >> 16]);
  if (size !== null) {
    const { width, height } = size;
    frame.set([0x9d, 0x01, 0x2a, width, width >> 8, height, height >> 8], 3);
  }
  return frame;
}
