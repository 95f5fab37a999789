/** A surface's tiles on the GPU: their samples as they were decoded, and which frame each tile shows. */
import { ExternalTexture, type WebGLRenderer } from 'three';

/** Samples of a tile: 16 rows of 16. */
export const TILE_SAMPLES = 256;
/** No image is narrower or higher than this many texels where it can be avoided: every WebGL 2 has room for them. */
const SIDE = 2048;
/** Texels of a row of the slots' texture. */
export const SLOTS_PER_ROW = 256;

/** How many tiles' samples lie in a row of the samples' texture. */
export function tilesPerRow(tiles: number): number {
  return Math.max(Math.ceil(tiles / SIDE), 1);
}

export class TileTextures {
  /** R32UI: each tile's samples lie one after another in one row. */
  readonly samples = new ExternalTexture();
  /** R8UI: each tile's slot (tile-map.ts). */
  readonly slots = new ExternalTexture();
  readonly perRow: number;
  readonly #renderer: WebGLRenderer;
  readonly #gl: WebGL2RenderingContext;
  readonly #tiles: number;
  readonly #slotRows: Uint8Array;

  constructor(renderer: WebGLRenderer, tiles: number) {
    this.#renderer = renderer;
    this.#gl = renderer.getContext() as WebGL2RenderingContext;
    this.#tiles = tiles;
    this.perRow = tilesPerRow(tiles);
    this.#slotRows = new Uint8Array(Math.ceil(tiles / SLOTS_PER_ROW) * SLOTS_PER_ROW);
    this.recreate();
  }

  /** Creates everything again after the GPU context was lost. */
  recreate(): void {
    const gl = this.#gl;
    const rows = Math.ceil(this.#tiles / this.perRow);
    this.samples.sourceTexture = this.#create(gl.R32UI, this.perRow * TILE_SAMPLES, rows);
    this.slots.sourceTexture = this.#create(gl.R8UI, SLOTS_PER_ROW, this.#slotRows.length / SLOTS_PER_ROW);
  }

  /**
   * Writes the samples of tiles that follow each other.
   *
   * @param samples {@link TILE_SAMPLES} for each tile, from index `from` on
   */
  write(samples: Uint32Array, from: number, firstTile: number, tiles: number): void {
    const gl = this.#gl;
    this.#bind(this.samples);
    for (let done = 0; done < tiles; ) {
      const tile = firstTile + done;
      const column = tile % this.perRow;
      // Whole rows at once, or what is in the first and the last row.
      const rows = column === 0 ? Math.max(Math.floor((tiles - done) / this.perRow), 1) : 1;
      const width = Math.min(this.perRow - column, tiles - done);
      gl.texSubImage2D(
        gl.TEXTURE_2D,
        0,
        column * TILE_SAMPLES,
        Math.floor(tile / this.perRow),
        width * TILE_SAMPLES,
        rows,
        gl.RED_INTEGER,
        gl.UNSIGNED_INT,
        samples,
        from + done * TILE_SAMPLES,
      );
      done += width * rows;
    }
  }

  /** Writes all tiles' slots. */
  writeSlots(slots: Uint8Array): void {
    const gl = this.#gl;
    this.#slotRows.set(slots);
    this.#bind(this.slots);
    const rows = this.#slotRows.length / SLOTS_PER_ROW;
    gl.texSubImage2D(
      gl.TEXTURE_2D,
      0,
      0,
      0,
      SLOTS_PER_ROW,
      rows,
      gl.RED_INTEGER,
      gl.UNSIGNED_BYTE,
      this.#slotRows,
    );
  }

  dispose(): void {
    for (const texture of [this.samples, this.slots]) {
      this.#gl.deleteTexture(texture.sourceTexture as WebGLTexture);
      texture.dispose();
    }
  }

  #bind(texture: ExternalTexture): void {
    const gl = this.#gl;
    const { state } = this.#renderer;
    state.bindTexture(gl.TEXTURE_2D, texture.sourceTexture as WebGLTexture);
    state.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
    state.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    state.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
    state.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
  }

  #create(format: number, width: number, height: number): WebGLTexture {
    const gl = this.#gl;
    const texture = gl.createTexture();
    this.#renderer.state.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    }
    return texture;
  }
}
