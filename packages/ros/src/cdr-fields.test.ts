import fc from 'fast-check';
import { expect, it } from 'vitest';
import { CdrFields } from './cdr-fields.ts';
import { RosFault } from './fault.ts';

/** A truth, a number that begins at the next fourth byte, and `é!`, in both byte orders. */
const LITTLE = [0, 1, 0, 0, 1, 0, 0, 0, 2, 1, 0, 0, 4, 0, 0, 0, 0xc3, 0xa9, 0x21, 0, 0xff];
const BIG = [0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 4, 0xc3, 0xa9, 0x21, 0, 0xff];

it.each([
  ['little', LITTLE],
  ['big', BIG],
])('fields are read in %s-endian order, each at its place', (_, bytes) => {
  const fields = new CdrFields(Uint8Array.from(bytes));
  expect(fields.bool()).toBe(true);
  expect(fields.uint32()).toBe(258);
  expect(fields.text()).toBe('é!');
  expect(fields.int8()).toBe(-1);
  expect(fields.left).toBe(0);
});

it('a text may lack its zero, and is cut where it is long', () => {
  expect(new CdrFields(Uint8Array.of(0, 1, 0, 0, 1, 0, 0, 0, 65)).text()).toBe('A');
  expect(new CdrFields(Uint8Array.of(0, 1, 0, 0, 0, 0, 0, 0)).text()).toBe('');
  const long = Uint8Array.of(0, 1, 0, 0, 0, 0x20, 0, 0, ...new Uint8Array(0x2000).fill(65));
  expect(new CdrFields(long).text()).toBe('A'.repeat(4096));
});

it.each([
  ['is no CDR', [0, 2, 0, 0, 1], 0],
  ['is of another version', [1, 1, 0, 0, 1], 0],
  ['has no header', [0, 1, 0], 3],
])('what %s is refused', (_, bytes, offset) => {
  expect(() => new CdrFields(Uint8Array.from(bytes))).toThrow(expect.objectContaining({ offset }));
});

it('neither true nor false, and what is cut, is refused at its place', () => {
  const fields = new CdrFields(Uint8Array.of(0, 1, 0, 0, 2, 0, 0));
  expect(() => fields.bool()).toThrow(/byte 4: 2 is neither/);
  expect(() => fields.uint32()).toThrow(/byte 5: it is cut short/);
});

it('whatever the bytes are, nothing but a fault is thrown', () => {
  const read = ['bool', 'int8', 'uint32', 'text'] as const;
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: 64 }), fc.array(fc.constantFrom(...read)), (bytes, order) => {
      try {
        const fields = new CdrFields(bytes);
        for (const each of order) fields[each]();
      } catch (error) {
        expect(error).toBeInstanceOf(RosFault);
      }
    }),
  );
});
