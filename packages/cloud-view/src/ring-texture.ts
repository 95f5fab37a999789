import { DataTexture } from 'three';
import { RING_TEXELS } from './ring-table.ts';

/** The ring table (ring-table.ts) for the shader: one row of bytes R, G, B, A, never interpolated. */
export function ringTexture(): DataTexture {
  return new DataTexture(new Uint8Array(RING_TEXELS * 4), RING_TEXELS, 1);
}
