/** Triangles of a Wavefront OBJ file: its vertices and faces, without materials, curves and lines. */
import { MeshFault } from './mesh-fault.ts';
import { MAX_FILE_TRIANGLES, TriangleList } from './triangle-list.ts';
import { numberOf } from './words.ts';

const LINE = /[^\r\n]+/g;
const MOST_LINE = 4096;
const MOST_CORNERS = 256;
const INDEX = /^-?\d{1,8}/;

/** @returns nine numbers for each triangle @throws {MeshFault} */
export function readObj(bytes: Uint8Array): Float32Array {
  const text = new TextDecoder('latin1').decode(bytes);
  const vertices: number[] = [];
  const triangles = new TriangleList();
  LINE.lastIndex = 0;
  for (let found = LINE.exec(text); found !== null; found = LINE.exec(text)) {
    const [line] = found;
    const kind = line.trimStart().slice(0, 2);
    if (!/^[vf]\s/.test(kind)) continue;
    if (line.length > MOST_LINE) throw new MeshFault('bad-mesh', 'a line of it is too long');
    const [what, ...words] = line.trim().split(/\s+/);
    if (what === 'v') {
      if (vertices.length >= 9 * MAX_FILE_TRIANGLES)
        throw new MeshFault('too-large', `it has more than ${3 * MAX_FILE_TRIANGLES} vertices`);
      vertices.push(numberOf(words[0]), numberOf(words[1]), numberOf(words[2]));
    } else addFace(words, vertices, triangles);
  }
  return triangles.corners;
}

/** As a fan around its first corner. */
function addFace(words: readonly string[], vertices: readonly number[], triangles: TriangleList): void {
  if (words.length < 3 || words.length > MOST_CORNERS)
    throw new MeshFault('bad-mesh', `a face of it has not 3 to ${MOST_CORNERS} corners`);
  const count = vertices.length / 3;
  const corners = words.map((word) => {
    const index = Number(INDEX.exec(word)?.[0] ?? 0);
    const at = index > 0 ? index - 1 : count + index;
    if (index === 0 || at < 0 || at >= count)
      throw new MeshFault('bad-mesh', 'a face of it has a vertex that is not there');
    return 3 * at;
  });
  for (let i = 1; i + 1 < corners.length; i++)
    for (const at of [corners[0], corners[i], corners[i + 1]] as number[])
      triangles.addCorner(vertices[at] as number, vertices[at + 1] as number, vertices[at + 2] as number);
}
