/** Meshes for tests, nine numbers for each triangle, and the files that have them. */

/** A ring about z: `around` × `across` × 2 triangles. */
export function torus(around: number, across: number, radius = 0.3, thickness = 0.1): number[] {
  const corner = (i: number, j: number): number[] => {
    const [a, b] = [(2 * Math.PI * i) / around, (2 * Math.PI * j) / across];
    const r = radius + thickness * Math.cos(b);
    return [r * Math.cos(a), r * Math.sin(a), thickness * Math.sin(b)].map(Math.fround);
  };
  const wrapped = (i: number, j: number) => corner(i % around, j % across);
  const corners: number[] = [];
  for (let i = 0; i < around; i++)
    for (let j = 0; j < across; j++) {
      const quad = [wrapped(i, j), wrapped(i + 1, j), wrapped(i + 1, j + 1), wrapped(i, j + 1)] as const;
      corners.push(...[quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]].flat());
    }
  return corners;
}

export function binaryStl(corners: readonly number[], header = 'solid although it is binary'): Uint8Array {
  const count = corners.length / 9;
  const bytes = new Uint8Array(84 + 50 * count);
  const view = new DataView(bytes.buffer);
  bytes.set(new TextEncoder().encode(header).subarray(0, 80));
  view.setUint32(80, count, true);
  corners.forEach((each, i) => {
    view.setFloat32(84 + 50 * Math.floor(i / 9) + 12 + 4 * (i % 9), each, true);
  });
  return bytes;
}

export function textStl(corners: readonly number[]): Uint8Array {
  const facets: string[] = [];
  for (let i = 0; i < corners.length; i += 9) {
    const vertices = [0, 3, 6].map((j) => `vertex ${corners.slice(i + j, i + j + 3).join(' ')}`);
    facets.push(`facet normal 0 0 0\n outer loop\n ${vertices.join('\n ')}\n endloop\nendfacet`);
  }
  return new TextEncoder().encode(`solid a ring of steel\n${facets.join('\n')}\nendsolid\n`);
}
