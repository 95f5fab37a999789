import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { HandshakeAssembler } from './handshake-assembler.ts';
import type { HandshakeFragment } from './handshake-message.ts';

/** Messages, cut into pieces that may overlap, shuffled and duplicated. */
const cutMessages = fc
  .array(fc.uint8Array({ maxLength: 40 }), { minLength: 1, maxLength: 6 })
  .chain((bodies) =>
    fc.record({
      bodies: fc.constant(bodies),
      cuts: fc.array(fc.tuple(fc.nat(bodies.length - 1), fc.nat(40), fc.nat(40)), { maxLength: 30 }),
      order: fc.array(fc.nat(), { minLength: 60, maxLength: 60 }),
    }),
  );

function whole(body: Uint8Array, messageSequence: number): HandshakeFragment {
  return { type: 11, length: body.length, messageSequence, offset: 0, data: Buffer.from(body) };
}

describe('HandshakeAssembler', () => {
  it('returns each message once, complete and in order, however its fragments arrive', () => {
    fc.assert(
      fc.property(cutMessages, ({ bodies, cuts, order }) => {
        const pieces = bodies.flatMap((body, n) => {
          const half = body.length >> 1;
          const { data, ...rest } = whole(body, n);
          return [
            { ...rest, data: data.subarray(0, half) },
            { ...rest, offset: half, data: data.subarray(half) },
          ];
        });
        for (const [n, from, length] of cuts) {
          const { data, ...rest } = whole(bodies[n] as Uint8Array, n);
          const offset = Math.min(from, data.length);
          pieces.push({ ...rest, offset, data: data.subarray(offset, offset + length) });
        }
        const shuffled = pieces
          .map((piece, n) => ({ piece, at: order[n % order.length] as number }))
          .sort((a, b) => a.at - b.at)
          .map(({ piece }) => piece);
        const assembler = new HandshakeAssembler();
        const given: Buffer[] = [];
        for (const piece of shuffled) {
          expect(['kept', 'old']).toContain(assembler.add(piece));
          for (let message = assembler.peek(); message !== null; message = assembler.peek()) {
            expect(message.messageSequence).toBe(given.length);
            given.push(message.body);
            assembler.take();
          }
        }
        expect(given).toEqual(bodies.map((body) => Buffer.from(body)));
      }),
      { seed: 4 },
    );
  });

  it('refuses fragments that contradict each other or are too far ahead', () => {
    const assembler = new HandshakeAssembler();
    const body = Buffer.from([1, 2, 3, 4]);
    const { data, ...rest } = whole(body, 0);
    expect(assembler.add({ ...rest, data: data.subarray(0, 2) })).toBe('kept');
    expect(assembler.add({ ...rest, type: 15, data })).toBe('contradictory');
    expect(assembler.add({ ...rest, length: 5, data })).toBe('contradictory');
    expect(assembler.add({ ...rest, offset: 2, data })).toBe('contradictory');
    expect(assembler.add(whole(body, 8))).toBe('too-far-ahead');
    expect(assembler.peek()).toBeNull();
  });

  it('accepts another message in place of a discarded one', () => {
    const assembler = new HandshakeAssembler();
    assembler.add(whole(Buffer.from([1]), 0));
    assembler.discard();
    assembler.add(whole(Buffer.from([2, 3]), 0));
    expect(assembler.peek()?.body).toEqual(Buffer.from([2, 3]));
  });
});
