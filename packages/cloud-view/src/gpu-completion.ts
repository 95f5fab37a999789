/** Whether the GPU has drawn what it was given. */
import type { WebGLRenderer } from 'three';

/** Tells whether the GPU has drawn what it was given. */
export class GpuCompletion {
  /** Told how long each picture took from its marking, ms, as far as {@link busy} was asked. */
  onCost: ((costMs: number) => void) | null = null;
  #fence: WebGLSync | null = null;
  #markedMs = 0;
  readonly #pixel = new Uint8Array(4);
  readonly #renderer: WebGLRenderer;

  /** @param renderer of WebGL 2, by which everything is drawn */
  constructor(renderer: WebGLRenderer) {
    this.#renderer = renderer;
  }

  /** Waits for it, by reading a pixel of it. Only where a time is measured: it stalls the pipeline. */
  wait(): void {
    const gl = this.#renderer.getContext() as WebGL2RenderingContext;
    const { xr, state } = this.#renderer;
    const layer = xr.isPresenting ? xr.getBaseLayer() : null;
    const framebuffer = layer !== null && 'framebuffer' in layer ? layer.framebuffer : null;
    state.bindFramebuffer(gl.FRAMEBUFFER, framebuffer as WebGLFramebuffer);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, this.#pixel);
  }

  /** The display frame is submitted. */
  mark(): void {
    const gl = this.#renderer.getContext() as WebGL2RenderingContext;
    if (this.#fence !== null) gl.deleteSync(this.#fence);
    this.#fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    this.#markedMs = performance.now();
  }

  /**
   * Whether the GPU still draws the display frame marked last. Another one behind it would only be shown later: a slow
   * GPU shows what is newest when it is free, not what was newest when it was asked.
   */
  get busy(): boolean {
    if (this.#fence === null) return false;
    const gl = this.#renderer.getContext() as WebGL2RenderingContext;
    if (!gl.isContextLost() && gl.getSyncParameter(this.#fence, gl.SYNC_STATUS) === gl.UNSIGNALED)
      return true;
    gl.deleteSync(this.#fence);
    this.#fence = null;
    this.onCost?.(performance.now() - this.#markedMs);
    return false;
  }
}
