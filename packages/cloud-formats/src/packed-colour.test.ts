import { expect, it } from 'vitest';
import { packedColour } from './packed-colour.ts';
import { decodePcd } from './pcd.ts';

const asFloat = (word: number) => new Float32Array(Uint32Array.of(word).buffer)[0] as number;

it.each([
  ['a float of its bits', asFloat(0xff8000), true, 0xff8000],
  ['a float of bits with opacity', asFloat(0x40ff8000), true, 0x40ff8000],
  ['the same, whose opacity makes it negative', asFloat(0xbfff8000), true, 0xbfff8000],
  ['its bits as a whole number, although it is a float', 0xff8000, true, 0xff8000],
  ['rounded to five digits', 4.2108e6, true, 4_210_800],
  ['black', 0, true, 0],
  ['a whole number', 0xffff8000, false, 0xffff8000],
  ['a negative whole number', -1, false, 0xffffffff],
  ['NaN', Number.NaN, true, null],
  ['infinity', Number.POSITIVE_INFINITY, true, null],
])('a colour as %s', (_, value, isFloat, bits) => {
  expect(packedColour(value, isFloat)).toBe(bits);
});

it('is what a PCD file as text has, and grey where it has none', () => {
  const header =
    'VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n';
  const text = `${header}1 2 3 16744448\n1 2 3 ${asFloat(0xff8000)}\n1 2 3 nan\n`;
  const words = new Uint32Array(decodePcd(new TextEncoder().encode(text)).points.buffer);
  expect([words[3], words[7], words[11]]).toEqual([0xff0080ff, 0xff0080ff, 0xffc8c8c8]);
});
