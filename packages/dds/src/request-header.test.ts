import fc from 'fast-check';
import { expect, it } from 'vitest';
import { readRequestHeader, withoutRequestHeader, withRequestHeader } from './request-header.ts';

const MESSAGE = Uint8Array.of(0, 1, 0, 0, 1, 2, 3);
const header = { client: 0x0807060504030201n, sequence: 258n };
/** By hand: the encapsulation, 64 bits of the client, 64 bits of the request, the message. */
const BYTES = [0, 1, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 2, 1, 0, 0, 0, 0, 0, 0, 1, 2, 3];

it('stands between the encapsulation and the message', () => {
  expect([...withRequestHeader(header, MESSAGE)]).toEqual(BYTES);
  expect(readRequestHeader(Uint8Array.from(BYTES))).toEqual(header);
  expect(withoutRequestHeader(Uint8Array.from(BYTES), 100)).toEqual(MESSAGE);
  expect(withoutRequestHeader(Uint8Array.from(BYTES), 2)).toEqual(MESSAGE.subarray(0, 6));
});

it('is read in the order of bytes that the encapsulation names', () => {
  const big = [0, 0, 0, 0, 8, 7, 6, 5, 4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 1, 2, 9];
  expect(readRequestHeader(Uint8Array.from(big))).toEqual(header);
});

it('is missed wherever it is cut', () => {
  for (let length = 0; length < 20; length++)
    expect(readRequestHeader(Uint8Array.from(BYTES.slice(0, length)))).toBeNull();
});

it('comes back as it was given, before any message', () => {
  const message = fc.uint8Array({ maxLength: 30 }).map((bytes) => Uint8Array.of(0, 1, 0, 0, ...bytes));
  fc.assert(
    fc.property(
      fc.bigInt(0n, 2n ** 64n - 1n),
      fc.bigInt(0n, 2n ** 63n - 1n),
      message,
      (client, sequence, m) => {
        const bytes = withRequestHeader({ client, sequence }, m);
        expect(readRequestHeader(bytes)).toEqual({ client, sequence });
        expect(withoutRequestHeader(bytes, 100)).toEqual(m);
      },
    ),
  );
});
