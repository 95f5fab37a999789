import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readNack } from './nack.ts';

function nack(entries: readonly (readonly [number, number])[]): Uint8Array {
  const bytes = new Uint8Array(12 + entries.length * 4);
  const view = new DataView(bytes.buffer);
  bytes[0] = 0x81;
  bytes[1] = 205;
  view.setUint16(2, bytes.length / 4 - 1);
  for (const [i, [pid, blp]] of entries.entries()) {
    view.setUint16(12 + i * 4, pid);
    view.setUint16(14 + i * 4, blp);
  }
  return bytes;
}

function read(bytes: Uint8Array) {
  const missing: number[] = [];
  const fault = readNack(bytes, (sequence) => missing.push(sequence));
  return { fault, missing };
}

describe('readNack', () => {
  it('reads a number and the sixteen after it, across the wrap', () => {
    expect(read(nack([[0xfffe, 0b1000_0000_0000_0101]]))).toEqual({
      fault: null,
      missing: [0xfffe, 0xffff, 1, 14],
    });
    expect(
      read(
        nack([
          [7, 0],
          [900, 2],
        ]),
      ),
    ).toEqual({ fault: null, missing: [7, 900, 902] });
  });

  it('refuses what is no NACK, and reports nothing from it', () => {
    const good = nack([[1, 0]]);
    const changed = (at: number, value: number) =>
      Uint8Array.from(good, (byte, i) => (i === at ? value : byte));
    expect(read(good.subarray(0, 12))).toEqual({ fault: 'truncated', missing: [] });
    expect(read(changed(0, 0x8f))).toEqual({ fault: 'not-nack', missing: [] });
    expect(read(changed(0, 0x41))).toEqual({ fault: 'not-nack', missing: [] });
    expect(read(changed(1, 206))).toEqual({ fault: 'not-nack', missing: [] });
    expect(read(changed(3, 9))).toEqual({ fault: 'bad-length', missing: [] });
    expect(read(changed(0, 0xa1))).toEqual({ fault: 'bad-length', missing: [] });
  });

  it('accepts any bytes without throwing', () => {
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 80 }), (bytes) => {
        const { fault, missing } = read(bytes);
        expect(fault === null || missing.length === 0).toBe(true);
        expect(missing.every((sequence) => sequence >= 0 && sequence <= 0xffff)).toBe(true);
      }),
    );
  });
});
