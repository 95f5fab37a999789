/** A camera's newest pictures on the GPU, as the layers of one texture. */
import { ExternalTexture, type WebGLRenderer } from 'three';

/**
 * Room for all layers together, bytes: five pictures of 1920 × 1080 (docs/cameras.md). Chosen: phones give a
 * page some hundred MB on their GPU.
 */
const MOST_BYTES = 48 * 1024 * 1024;
/**
 * The newest pictures wait for their frames, and a frame is drawn for some time. Chosen: some intervals
 * between pictures (docs/cameras.md).
 */
const LEAST_LAYERS = 4;
const MOST_LAYERS = 8;
const PIXEL_BYTES = 4;

/** How many pictures of a size are kept; 0: even the fewest take too much memory. */
export function layersFor(width: number, height: number): number {
  const layers = Math.floor(MOST_BYTES / (width * height * PIXEL_BYTES));
  return layers < LEAST_LAYERS ? 0 : Math.min(layers, MOST_LAYERS);
}

export class PictureTextures {
  readonly texture = new ExternalTexture();
  readonly width: number;
  readonly height: number;
  readonly layers: number;
  readonly #renderer: WebGLRenderer;
  readonly #gl: WebGL2RenderingContext;

  /** @param layers at least 1 */
  constructor(renderer: WebGLRenderer, width: number, height: number, layers: number) {
    this.#renderer = renderer;
    this.#gl = renderer.getContext() as WebGL2RenderingContext;
    this.width = width;
    this.height = height;
    this.layers = layers;
    this.recreate();
  }

  /** Creates everything again after the GPU context was lost. */
  recreate(): void {
    const gl = this.#gl;
    const texture = gl.createTexture();
    this.texture.sourceTexture = texture;
    this.#renderer.state.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGBA8, this.width, this.height, this.layers);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D_ARRAY, filter, gl.LINEAR);
    }
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
      gl.texParameteri(gl.TEXTURE_2D_ARRAY, wrap, gl.CLAMP_TO_EDGE);
    }
  }

  /** @param image of this width and height @throws {TypeError} if this browser takes no such image as a texture */
  write(layer: number, image: TexImageSource): void {
    const gl = this.#gl;
    const { state } = this.#renderer;
    state.bindTexture(gl.TEXTURE_2D_ARRAY, this.texture.sourceTexture as WebGLTexture);
    state.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
    state.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    state.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
    state.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
    gl.texSubImage3D(
      gl.TEXTURE_2D_ARRAY,
      0,
      0,
      0,
      layer,
      this.width,
      this.height,
      1,
      gl.RGBA,
      gl.UNSIGNED_BYTE,
      image,
    );
  }

  dispose(): void {
    this.#gl.deleteTexture(this.texture.sourceTexture as WebGLTexture);
    this.texture.dispose();
  }
}
