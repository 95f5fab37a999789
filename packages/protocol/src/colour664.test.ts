import { expect, test } from 'vitest';
import {
  LATENCY_TEST_COLOUR,
  packColour664,
  unpackBlue664,
  unpackGreen664,
  unpackRed664,
} from './colour664.ts';
import { readVectors } from './testing/vectors.ts';

type Rgb = [number, number, number];
const vectors = readVectors<{
  pack: { rgb: Rgb; colour: number }[];
  unpack: { colour: number; rgb: Rgb }[];
}>('colour664');

const unpack = (colour: number): Rgb => [unpackRed664(colour), unpackGreen664(colour), unpackBlue664(colour)];

test.each(vectors.pack)('pack $rgb', ({ rgb, colour }) => {
  expect(packColour664(...rgb)).toBe(colour);
});

test.each(vectors.unpack)('unpack $colour', ({ colour, rgb }) => {
  expect(unpack(colour)).toEqual(rgb);
});

test('every one of the 65,536 colours survives unpacking and packing', () => {
  for (let colour = 0; colour <= 0xffff; colour++) {
    if (packColour664(...unpack(colour)) !== colour) expect.fail(`colour ${colour}`);
  }
});

test('the latency test’s green is pure green', () => {
  expect(packColour664(0, 255, 0)).toBe(LATENCY_TEST_COLOUR);
});
