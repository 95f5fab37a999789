import fc from 'fast-check';
import { expect, test } from 'vitest';
import { MeshFault } from './mesh-fault.ts';
import { readStl } from './stl.ts';
import { binaryStl, textStl, torus } from './testing/solids.ts';
import { MAX_FILE_TRIANGLES } from './triangle-list.ts';

const text = (words: string) => new TextEncoder().encode(words);
const RING = torus(6, 4);

function faultOf(bytes: Uint8Array): string {
  try {
    readStl(bytes);
  } catch (error) {
    if (error instanceof MeshFault) return error.code;
    throw error;
  }
  return 'none';
}

test('a binary file and one of text have the same triangles, also where the binary one begins with “solid”', () => {
  const expected = Float32Array.from(RING);
  expect(readStl(binaryStl(RING))).toEqual(expected);
  expect(readStl(binaryStl(RING, 'made by a machine'))).toEqual(expected);
  expect(readStl(textStl(RING))).toEqual(expected);
  expect(readStl(text('SOLID\r\nENDSOLID'))).toHaveLength(0);
});

test('what is no STL, cut off, or nowhere is refused', () => {
  const whole = binaryStl(RING);
  const nowhere = binaryStl([Number.NaN, ...RING.slice(1)]);
  const far = binaryStl([1e7, ...RING.slice(1)]);
  for (const bytes of [
    new Uint8Array(0),
    text('<html>'),
    whole.subarray(0, -1),
    text('solid x facet'),
    nowhere,
    far,
  ])
    expect(faultOf(bytes)).toBe('bad-mesh');
  const facet = (vertex: string) =>
    `solid\nfacet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex ${vertex} endloop endfacet endsolid`;
  expect(faultOf(text(facet('0 1 0')))).toBe('none');
  for (const vertex of ['0 1', '0 1 x', '0 1 1e999', '0 1 Infinity', '0 1 0 vertex 1 1 1', '0x1 0 0'])
    expect(faultOf(text(facet(vertex)))).toBe('bad-mesh');
});

test('a count that the file cannot have takes no memory, and one that is too large is refused', () => {
  const lying = binaryStl(RING);
  new DataView(lying.buffer).setUint32(80, 0xffffffff, true);
  expect(faultOf(lying)).toBe('bad-mesh');
  const large = new Uint8Array(84 + 50 * (MAX_FILE_TRIANGLES + 1));
  new DataView(large.buffer).setUint32(80, MAX_FILE_TRIANGLES + 1, true);
  expect(faultOf(large)).toBe('too-large');
});

test('whatever the bytes, it is triangles or a fault', () => {
  const seeds = [binaryStl(RING), textStl(RING)];
  fc.assert(
    fc.property(
      fc.constantFrom(...seeds),
      fc.array(fc.tuple(fc.nat(), fc.nat(255)), { maxLength: 20 }),
      fc.nat(),
      (seed, changes, end) => {
        const bytes = seed.slice(0, end % 2 === 0 ? seed.length : end % seed.length);
        for (const [at, value] of changes) if (bytes.length > 0) bytes[at % bytes.length] = value;
        expect(['none', 'bad-mesh', 'too-large']).toContain(faultOf(bytes));
      },
    ),
    { seed: 5, numRuns: 500 },
  );
});
