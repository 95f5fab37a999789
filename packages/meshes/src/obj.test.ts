import { expect, test } from 'vitest';
import { MeshFault } from './mesh-fault.ts';
import { readObj } from './obj.ts';

const read = (...lines: string[]) => readObj(new TextEncoder().encode(lines.join('\n')));
const SQUARE = ['# made by hand', 'mtllib x.mtl', 'v 0 0 0', 'v 1 0 0', 'v 1 1 0 1.0', 'vn 0 0 1', 'v 0 1 0'];

test('a face is a fan of triangles; its vertices are counted from the beginning or from its end', () => {
  const expected = Float32Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0);
  expect(read(...SQUARE, 'usemtl m', 'f 1//1 2//1 3//1 4//1')).toEqual(expected);
  expect(read(...SQUARE, 'f -4 -3/7/1 -2 -1\r')).toEqual(expected);
  expect(read(...SQUARE)).toHaveLength(0);
});

test('vertices that are not there, and numbers that are none, are refused', () => {
  for (const line of ['f 1 2 5', 'f 0 1 2', 'f 1 2', 'f -5 1 2', 'f a b c', `f ${'1 '.repeat(300)}`])
    expect(() => read(...SQUARE, line)).toThrow(MeshFault);
  expect(() => read('v 0 0 x', 'v 0 0 0', 'v 1 0 0', 'f 1 2 3')).toThrow('a vertex is nowhere');
  expect(() => read(...SQUARE, `f 1 2 3${' '.repeat(5000)}`)).toThrow('too long');
});
