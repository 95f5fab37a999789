/**
 * How many triangles each mesh of a model may have, so that together they are drawn with no more than `most`. Small ones stay
 * whole; the others get equally many.
 *
 * @param meshes their triangles, and how often they are drawn
 */
export function triangleShares(
  meshes: readonly { triangles: number; drawn: number }[],
  most: number,
): number[] {
  const total = (cap: number) =>
    meshes.reduce((sum, { triangles, drawn }) => sum + drawn * Math.min(triangles, cap), 0);
  let [low, high] = [1, meshes.reduce((largest, { triangles }) => Math.max(largest, triangles), 1)];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (total(middle) <= most) low = middle;
    else high = middle - 1;
  }
  return meshes.map(({ triangles }) => Math.min(triangles, low));
}
