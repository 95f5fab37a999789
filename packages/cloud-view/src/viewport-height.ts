import type { WebGLRenderer } from 'three';

/** Height of one eye's picture, pixels of the drawing buffer. */
export function viewportHeightOf({ xr, domElement }: WebGLRenderer): number {
  if (!xr.isPresenting) return domElement.height;
  return xr.getCamera().cameras[0]?.viewport?.w ?? domElement.height;
}
