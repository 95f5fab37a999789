import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { readPly } from './ply.ts';
import { PointFileError } from './point-file.ts';

function ply(header: string, data: Uint8Array = new Uint8Array()): Uint8Array {
  return new Uint8Array([...new TextEncoder().encode(header), ...data]);
}

const XYZ = 'property float x\nproperty float y\nproperty float z\n';
const LITTLE = 'ply\nformat binary_little_endian 1.0\n';

describe('readPly', () => {
  test('reads other programs’ files: doubles, normals between, colours as fractions, faces after the vertices', () => {
    const header =
      `${LITTLE}comment made elsewhere\r\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\n` +
      'property float nx\nproperty float red\nproperty float green\nproperty float blue\n' +
      'element face 1\nproperty list uchar int vertex_indices\nend_header\n';
    const data = new DataView(new ArrayBuffer(80));
    for (const [i, value] of [1, -2, 3.5].entries()) data.setFloat64(i * 8, value, true);
    for (const [i, value] of [9, 1, 0.5, 0].entries()) data.setFloat32(24 + i * 4, value, true);
    data.setFloat64(40, Number.NaN, true);
    const file = readPly(ply(header, new Uint8Array(data.buffer)));
    expect(file.count).toBe(1);
    expect([...file.places.subarray(0, 3)]).toEqual([1, -2, 3.5]);
    expect(file.colours[0]).toBe((31 << 11) | (32 << 5));
    expect(file.savedAt).toBe(null);
  });

  test.each([
    ['no PLY', 'pcd\n', /no PLY/],
    ['text', `ply\nformat ascii 1.0\nelement vertex 1\n${XYZ}end_header\n`, /ascii/],
    ['no end', `${LITTLE}element vertex 1\n${XYZ}`, /header does not end/],
    ['too short', `${LITTLE}element vertex 9\n${XYZ}end_header\n`, /ends before/],
    ['too many', `${LITTLE}element vertex 1e15\n${XYZ}end_header\n`, /number of vertices/],
    ['no z', `${LITTLE}element vertex 0\nproperty float x\nproperty float y\nend_header\n`, /no z/],
    ['a list', `${LITTLE}element vertex 0\nproperty list uchar int x\nend_header\n`, /type list/],
    ['faces first', `${LITTLE}element face 1\nelement vertex 0\n${XYZ}end_header\n`, /face comes before/],
  ])('refuses %s', (_, text, message) => {
    expect(() => readPly(ply(text))).toThrow(message);
  });

  test('reads anything or says what is wrong', () => {
    const word = fc.constantFrom(
      ...[
        'ply',
        'format binary_little_endian 1.0',
        'element vertex 3',
        'element vertex -1',
        'element',
        'property',
      ],
      ...[
        'property float x',
        'property uchar y',
        'property double z',
        'property short red',
        'end_header',
        'comment',
      ],
    );
    fc.assert(
      fc.property(fc.array(word, { maxLength: 12 }), fc.uint8Array({ maxLength: 80 }), (lines, data) => {
        try {
          const { count, places } = readPly(ply(`ply\n${lines.join('\n')}\n`, data));
          expect(places.length).toBeGreaterThanOrEqual(count * 3);
        } catch (error) {
          expect(error).toBeInstanceOf(PointFileError);
        }
      }),
      { numRuns: 2000 },
    );
  });
});
