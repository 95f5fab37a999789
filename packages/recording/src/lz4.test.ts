import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { RecordingError } from './errors.ts';
import { decompressLz4 } from './lz4.ts';

/** A frame with one block of handwritten sequences. */
function frame(block: number[], { stored = false, flags = 0x40 } = {}): Uint8Array {
  const size = [block.length & 0xff, block.length >> 8, 0, stored ? 0x80 : 0];
  const checks = (flags & 16) === 0 ? [] : [9, 9, 9, 9];
  const end = (flags & 4) === 0 ? [] : [8, 8, 8, 8];
  const header = [0x04, 0x22, 0x4d, 0x18, flags, 0x40, 0];
  return Uint8Array.from([...header, ...size, ...block, ...checks, 0, 0, 0, 0, ...end]);
}

const text = (bytes: Uint8Array) => new TextDecoder().decode(bytes);
const codes = (words: string) => [...new TextEncoder().encode(words)];

describe('decompressLz4', () => {
  it('reads literals, matches, matches that overlap themselves, and long lengths', () => {
    // "abc", then 8 bytes from 3 back, then "!".
    expect(text(decompressLz4(frame([0x34, ...codes('abc'), 3, 0, 0x10, ...codes('!')]), 12))).toBe(
      'abcabcabcab!',
    );
    // One byte, then 15 + 255 + 7 + 4 copies of it.
    const run = decompressLz4(frame([0x1f, 120, 1, 0, 255, 7, 0x00]), 282);
    expect(text(run)).toBe('x'.repeat(282));
    // 15 + 20 literals.
    const words = 'the quick brown fox jumps over dogs';
    expect(text(decompressLz4(frame([0xf0, 20, ...codes(words)]), 35))).toBe(words);
  });

  it('reads stored blocks, checksums, several frames, and skippable frames', () => {
    const stored = frame(codes('stored'), { stored: true, flags: 0x40 | 16 | 4 });
    const skipped = Uint8Array.from([0x53, 0x2a, 0x4d, 0x18, 2, 0, 0, 0, 1, 2]);
    const both = Buffer.concat([stored, skipped, frame([0x20, ...codes('ok')])]);
    expect(text(decompressLz4(both, 8))).toBe('storedok');
  });

  it('continues after a damaged chunk', () => {
    const whole = frame([0x20, ...codes('ok')]);
    expect(() => decompressLz4(whole.subarray(0, 9), 2)).toThrow(RecordingError);
    expect(() => decompressLz4(Uint8Array.from(codes('no LZ4 at all')), 2)).toThrow(RecordingError);
    expect(text(decompressLz4(whole, 2))).toBe('ok');
  });

  it('refuses everything else with a typed error, and never writes beyond its size', () => {
    let errors = 0;
    const bytes = fc.array(fc.integer({ min: 0, max: 255 }), { maxLength: 60 });
    fc.assert(
      fc.property(bytes, fc.integer({ min: 0, max: 100 }), fc.boolean(), (block, size, framed) => {
        try {
          const output = decompressLz4(framed ? frame(block) : Uint8Array.from(block), size);
          expect(output.length).toBeLessThanOrEqual(size);
        } catch (error) {
          expect(error).toBeInstanceOf(RecordingError);
          errors++;
        }
      }),
      { numRuns: 2000 },
    );
    expect(errors).toBeGreaterThan(1000);
  });
});
