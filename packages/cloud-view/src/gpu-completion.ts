/** Completion of the GPU's work. */
import type { WebGLRenderer } from 'three';

/**
 * When a picture is looked at for the first time, ms: within the time that {@link DrawGate} calls cheap. By the next display
 * frame alone, every picture would seem to take as long as a display frame.
 */
const EARLY_MS = 5;

/** Tells whether the GPU has finished drawing. */
export class GpuCompletion {
  /** Called with the time from {@link mark} until the picture is found finished, ms. */
  onCost: ((costMs: number) => void) | null = null;
  #fence: WebGLSync | null = null;
  #markedMs = 0;
  readonly #lookEarly = () => void this.#finished();
  readonly #pixel = new Uint8Array(4);
  readonly #renderer: WebGLRenderer;

  /** @param renderer the WebGL 2 renderer that draws everything */
  constructor(renderer: WebGLRenderer) {
    this.#renderer = renderer;
  }

  /** Waits for the GPU by reading a pixel. This stalls the pipeline, so call it only for a measurement. */
  wait(): void {
    const gl = this.#renderer.getContext() as WebGL2RenderingContext;
    const { xr, state } = this.#renderer;
    const layer = xr.isPresenting ? xr.getBaseLayer() : null;
    const framebuffer = layer !== null && 'framebuffer' in layer ? layer.framebuffer : null;
    state.bindFramebuffer(gl.FRAMEBUFFER, framebuffer as WebGLFramebuffer);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, this.#pixel);
  }

  /** The display frame has been submitted. */
  mark(): void {
    const gl = this.#renderer.getContext() as WebGL2RenderingContext;
    if (this.#fence !== null) gl.deleteSync(this.#fence);
    this.#fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    this.#markedMs = performance.now();
    setTimeout(this.#lookEarly, EARLY_MS);
  }

  /**
   * Whether the GPU is still drawing the display frame that was marked last. Then nothing should be submitted: a queued
   * frame would be outdated when shown. A slow GPU should get the newest points once it is free.
   */
  get busy(): boolean {
    return !this.#finished();
  }

  /** Looks whether the picture that was marked last is finished, and tells its cost once. */
  #finished(): boolean {
    if (this.#fence === null) return true;
    const gl = this.#renderer.getContext() as WebGL2RenderingContext;
    if (!gl.isContextLost() && gl.getSyncParameter(this.#fence, gl.SYNC_STATUS) === gl.UNSIGNALED)
      return false;
    gl.deleteSync(this.#fence);
    this.#fence = null;
    this.onCost?.(performance.now() - this.#markedMs);
    return true;
  }
}
