import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { MessageAssembly, MOST_MESSAGE_BYTES } from './message-assembly.ts';

function framed(message: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(4 + message.length);
  new DataView(bytes.buffer).setUint32(0, message.length, true);
  bytes.set(message, 4);
  return bytes;
}

describe('MessageAssembly', () => {
  it('assembles messages, however the stream is split, from memory that is overwritten', () => {
    const messages = fc.array(fc.uint8Array({ maxLength: 300 }), { maxLength: 12 });
    fc.assert(
      fc.property(messages, fc.array(fc.integer({ min: 1, max: 200 }), { minLength: 1 }), (sent, cuts) => {
        const got: Uint8Array[] = [];
        const assembly = new MessageAssembly((message) => got.push(message.slice()));
        const stream = Buffer.concat(sent.map(framed));
        const chunk = new Uint8Array(200);
        for (let at = 0, i = 0; at < stream.length; i++) {
          const length = Math.min(cuts[i % cuts.length] as number, stream.length - at);
          chunk.fill(0xee);
          chunk.set(stream.subarray(at, at + length));
          assembly.add(chunk.subarray(0, length));
          at += length;
        }
        expect(got).toEqual(sent.map(framed));
      }),
    );
  });

  it('accepts messages larger than its memory, then small ones again', () => {
    const got: number[] = [];
    const assembly = new MessageAssembly((message) => got.push(message.length));
    assembly.add(framed(new Uint8Array(1_000_000)));
    assembly.add(framed(new Uint8Array(3)));
    expect(got).toEqual([1_000_004, 7]);
  });

  it('refuses an impossible length before it allocates memory for it', () => {
    const assembly = new MessageAssembly(() => {});
    const head = new Uint8Array(8);
    new DataView(head.buffer).setUint32(0, MOST_MESSAGE_BYTES + 1, true);
    expect(() => assembly.add(head)).toThrow(RangeError);
  });
});
