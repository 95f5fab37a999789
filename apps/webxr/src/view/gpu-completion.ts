/** Waits until the GPU has drawn everything so far. Only where a time is measured: it stalls the pipeline. */
import type { WebGLRenderer } from 'three';

export class GpuCompletion {
  readonly #pixel = new Uint8Array(4);
  readonly #renderer: WebGLRenderer;

  constructor(renderer: WebGLRenderer) {
    this.#renderer = renderer;
  }

  /** Reads one pixel of what was drawn to: that cannot answer before it is drawn. */
  wait(): void {
    const gl = this.#renderer.getContext() as WebGL2RenderingContext;
    const { xr, state } = this.#renderer;
    const layer = xr.isPresenting ? xr.getBaseLayer() : null;
    const framebuffer = layer !== null && 'framebuffer' in layer ? layer.framebuffer : null;
    state.bindFramebuffer(gl.FRAMEBUFFER, framebuffer as WebGLFramebuffer);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, this.#pixel);
  }
}
