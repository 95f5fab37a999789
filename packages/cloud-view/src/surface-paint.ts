/**
 * Paints a surface with its camera's own pictures, e.g. a video's, instead of the packets' colours. As the picture has the
 * cloud's lens and place, a sample's place in the grid is its place in the picture. A frame is painted only with the
 * picture of its own capture instant. Allocates nothing per frame.
 */
import type { WebGLRenderer } from 'three';
import type { CameraPicture, CloudPaint, PictureUse } from './cloud-paint.ts';
import { PictureMatch } from './picture-match.ts';
import { layersFor, PictureTextures } from './picture-textures.ts';
import { SlotWeights } from './slot-weights.ts';
import type { PaintUniforms } from './surface-material.ts';
import { FRAME_SLOTS } from './tile-map.ts';

/** Sides are rounded when a picture is scaled: the ratios of picture and grid may differ by this share. */
const SAME_SHAPE = 0.03;
/** Time constant of the mean share, ms. Chosen: a number that people can read. */
const SHARE_MS = 500;

export class SurfacePaint implements CloudPaint {
  on = true;
  share = 0;
  readonly #renderer: WebGLRenderer;
  readonly #uniforms: PaintUniforms;
  readonly #match = new PictureMatch(1);
  readonly #weights = new SlotWeights();
  /** When each slot's frame was captured, µs modulo 2³²; −1: it has none. */
  readonly #instants = new Float64Array(FRAME_SLOTS).fill(-1);
  readonly #layerOf = (slot: number): number | null => {
    const instant = this.#instants[slot] as number;
    return instant < 0 ? null : this.#match.layerOf(instant);
  };
  #textures: PictureTextures | null = null;
  #newestSlot = 0;
  #updatedMs = 0;
  /** Whether a surface is drawn. */
  #active = false;

  constructor(renderer: WebGLRenderer, uniforms: PaintUniforms) {
    this.#renderer = renderer;
    this.#uniforms = uniforms;
  }

  expect(instantUs: number): void {
    this.#match.expect(instantUs);
  }

  take(picture: CameraPicture, instantUs: number): PictureUse {
    const { width, height, image } = picture;
    const { x: columns, y: rows } = this.#uniforms.gridSize.value;
    if (!this.#active) return 'no-surface';
    if (Math.abs((width * rows) / (height * columns) - 1) > SAME_SHAPE) return 'other-shape';
    const textures = this.#texturesFor(width, height);
    if (textures === null) return 'too-large';
    const layer = this.#match.place(instantUs);
    if (layer === null) return 'between-frames';
    try {
      textures.write(layer, image);
      return this.#match.isFrame(instantUs) ? 'matched' : 'early';
    } catch {
      this.#match.forgetPictures();
      return 'unreadable';
    }
  }

  /** The surface begins anew. @param width of the image that it lies on, pixels, as is `height` */
  follow(width: number, height: number): void {
    this.#uniforms.gridSize.value.set(width, height);
    this.forget();
  }

  /** A slot's frame begins. @param instantUs when it was captured, µs modulo 2³² */
  begin(slot: number, instantUs: number): void {
    this.#active = true;
    this.#newestSlot = slot;
    this.#instants[slot] = instantUs;
    this.#match.expect(instantUs);
    this.#weights.begin(slot, this.on && this.#layerOf(slot) !== null);
  }

  /** Call it before each rendering. */
  update(nowMs: number): void {
    this.#weights.update(nowMs, this.on, this.#layerOf);
    const step = Math.min((nowMs - this.#updatedMs) / SHARE_MS, 1);
    this.#updatedMs = nowMs;
    this.share += ((this.#weights.weights[this.#newestSlot] as number) - this.share) * step;
    const { value } = this.#uniforms.tilePaint;
    for (let slot = 0; slot < FRAME_SLOTS; slot++) {
      const weight = this.#weights.weights[slot] as number;
      value[slot >> 2]!.setComponent(slot & 3, weight === 0 ? 0 : this.#layerOf(slot)! + weight / 2);
    }
  }

  /** Discards what is shown, and the pictures. */
  forget(): void {
    this.#active = false;
    this.share = 0;
    this.#match.forget();
    this.#weights.clear();
    this.#instants.fill(-1);
  }

  /** A lost GPU context was restored. */
  recreate(): void {
    this.#textures?.recreate();
    this.forget();
  }

  /** Frees the GPU's memory. */
  dispose(): void {
    this.#textures?.dispose();
  }

  /** Pictures of another size than before take the place of all. `null`: they are too large. */
  #texturesFor(width: number, height: number): PictureTextures | null {
    if (this.#textures?.width === width && this.#textures.height === height) return this.#textures;
    const layers = layersFor(width, height);
    if (layers === 0) return null;
    this.#textures?.dispose();
    this.#textures = new PictureTextures(this.#renderer, width, height, layers);
    this.#uniforms.pictures.value = this.#textures.texture;
    this.#match.forgetPictures(layers);
    return this.#textures;
  }
}
