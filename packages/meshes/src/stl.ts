/** Triangles of an STL file, binary or as text. */
import { MeshFault } from './mesh-fault.ts';
import { MAX_FILE_TRIANGLES, TriangleList } from './triangle-list.ts';
import { numberOf, Words } from './words.ts';

const HEADER_BYTES = 84;
const COUNT_AT = 80;
const TRIANGLE_BYTES = 50;
/** A triangle begins with its normal, which is known from its corners. */
const NORMAL_BYTES = 12;
const SOLID = /^\s*solid\b[^\r\n]*/i;

/** @returns nine numbers for each triangle @throws {MeshFault} */
export function readStl(bytes: Uint8Array): Float32Array {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = bytes.length < HEADER_BYTES ? -1 : view.getUint32(COUNT_AT, true);
  // Binary files often begin with "solid" as well: only their length tells.
  if (count >= 0 && bytes.length === HEADER_BYTES + TRIANGLE_BYTES * count) return binary(view, count);
  const text = new TextDecoder('latin1').decode(bytes);
  const name = SOLID.exec(text);
  if (name !== null) return readText(new Words(text, name[0].length));
  throw new MeshFault('bad-mesh', 'it is no STL, or is cut off');
}

function binary(view: DataView, count: number): Float32Array {
  if (count > MAX_FILE_TRIANGLES)
    throw new MeshFault('too-large', `it has more than ${MAX_FILE_TRIANGLES} triangles`);
  const triangles = new TriangleList(count);
  for (let i = 0; i < count; i++) {
    const at = HEADER_BYTES + TRIANGLE_BYTES * i + NORMAL_BYTES;
    for (let corner = at; corner < at + 36; corner += 12)
      triangles.addCorner(
        view.getFloat32(corner, true),
        view.getFloat32(corner + 4, true),
        view.getFloat32(corner + 8, true),
      );
  }
  return triangles.corners;
}

function readText(words: Words): Float32Array {
  const triangles = new TriangleList();
  const expect = (...wanted: string[]) => {
    for (const each of wanted) {
      const word = words.next();
      if (word?.toLowerCase() !== each) throw new MeshFault('bad-mesh', `“${each}” is expected in it`);
    }
  };
  for (let word = words.next(); word?.toLowerCase() !== 'endsolid'; word = words.next()) {
    if (word?.toLowerCase() !== 'facet') throw new MeshFault('bad-mesh', 'it is no STL, or is cut off');
    expect('normal');
    for (let i = 0; i < 3; i++) words.next();
    expect('outer', 'loop');
    for (let corner = 0; corner < 3; corner++) {
      expect('vertex');
      triangles.addCorner(numberOf(words.next()), numberOf(words.next()), numberOf(words.next()));
    }
    expect('endloop', 'endfacet');
  }
  return triangles.corners;
}
