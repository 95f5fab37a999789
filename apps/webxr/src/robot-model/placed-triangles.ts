/** Triangles in a link's own axes: three corners each, nine numbers. */
export interface PlacedTriangles {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
}
