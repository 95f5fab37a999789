/** Remembered surfels on the GPU, as they were handed on: a page after the other, RG32UI. */
import { MEMORY_LAYOUT } from '@farpoint/operator';
import { ExternalTexture, type WebGLRenderer } from 'three';
import { PAGES_PER_ROW } from './memory-material.ts';

const { pages, pageSurfels } = MEMORY_LAYOUT;

export class MemoryTexture {
  readonly texture = new ExternalTexture();
  readonly #renderer: WebGLRenderer;
  readonly #gl: WebGL2RenderingContext;

  constructor(renderer: WebGLRenderer) {
    this.#renderer = renderer;
    this.#gl = renderer.getContext() as WebGL2RenderingContext;
  }

  /** Writes a page's surfels. @param from index of their first word */
  write(page: number, words: Uint32Array, from: number, surfels: number): void {
    if (surfels === 0) return;
    const gl = this.#gl;
    const { state } = this.#renderer;
    // 16 MiB, which a page that remembers nothing does not need.
    this.texture.sourceTexture ??= this.#create();
    state.bindTexture(gl.TEXTURE_2D, this.texture.sourceTexture as WebGLTexture);
    state.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
    state.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    state.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
    state.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
    const [x, y] = [(page % PAGES_PER_ROW) * pageSurfels, Math.floor(page / PAGES_PER_ROW)];
    gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, surfels, 1, gl.RG_INTEGER, gl.UNSIGNED_INT, words, from);
  }

  /** A lost GPU context was restored: everything must be written again. */
  recreate(): void {
    this.texture.sourceTexture = null;
  }

  dispose(): void {
    this.#gl.deleteTexture(this.texture.sourceTexture as WebGLTexture | null);
    this.texture.dispose();
  }

  #create(): WebGLTexture {
    const gl = this.#gl;
    const texture = gl.createTexture();
    this.#renderer.state.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RG32UI, PAGES_PER_ROW * pageSurfels, pages / PAGES_PER_ROW);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    return texture;
  }
}
