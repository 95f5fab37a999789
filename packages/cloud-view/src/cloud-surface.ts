/** A cloud on a camera's grid, drawn as a surface: writes tiles to the GPU as they arrive. Allocates nothing. */
import type { Batch, TileGrid } from '@farpoint/operator';
import { pointsOfBytes } from '@farpoint/protocol';
import {
  BufferAttribute,
  DoubleSide,
  InstancedBufferGeometry,
  Mesh,
  type RawShaderMaterial,
  Sphere,
  Vector3,
  type WebGLRenderer,
} from 'three';
import { writePose } from './batch-pose.ts';
import type { PointUniforms } from './point-material.ts';
import { featuresOf, setFeatures } from './shader-features.ts';
import { createSurfaceMaterial } from './surface-material.ts';
import { SurfacePaint } from './surface-paint.ts';
import { STRIDES, strideFor, TILE, tileIndices } from './tile-geometry.ts';
import { FRAME_SLOTS, TileMap } from './tile-map.ts';
import { TILE_SAMPLES, TileTextures } from './tile-textures.ts';

/** Room that a tile takes in a batch, in points. */
const TILE_ROOM = TILE_SAMPLES / 2;

export class CloudSurface extends Mesh<InstancedBufferGeometry, RawShaderMaterial> {
  /** Which frame each tile shows. */
  map = new TileMap(0);
  /** Paints it with its camera's own pictures. */
  readonly paint: SurfacePaint;
  readonly #renderer: WebGLRenderer;
  readonly #uniforms: ReturnType<typeof createSurfaceMaterial>['uniforms'];
  readonly #points: PointUniforms;
  readonly #indices = STRIDES.map((stride) => new BufferAttribute(tileIndices(stride), 1));
  readonly #grid: TileGrid = { width: 0, height: 0, fx: 0, fy: 0, cx: 0, cy: 0 };
  readonly #given: TileGrid = { ...this.#grid };
  #textures: TileTextures | null = null;
  #changed = false;

  /** @param points the uniforms that surfaces share with points */
  constructor(renderer: WebGLRenderer, points: PointUniforms) {
    const { material, uniforms } = createSurfaceMaterial(points);
    material.side = DoubleSide;
    super(new InstancedBufferGeometry(), material);
    this.#renderer = renderer;
    this.#uniforms = uniforms;
    this.#points = points;
    this.paint = new SurfacePaint(renderer, uniforms);
    this.geometry.boundingSphere = new Sphere(new Vector3(), Number.POSITIVE_INFINITY);
    this.frustumCulled = false;
    this.visible = false;
    this.every = 1;
  }

  /** Draws about one of this many samples. */
  set every(every: number) {
    const stride = strideFor(every);
    this.#uniforms.tileGrid.value[3] = stride;
    this.geometry.setIndex(this.#indices[STRIDES.indexOf(stride)] as BufferAttribute);
  }

  /** Number of samples that are drawn, whether seen or not. */
  get drawn(): number {
    return (this.map.shown * TILE_SAMPLES) / (this.#uniforms.tileGrid.value[3] as number) ** 2;
  }

  /**
   * Takes a packet's tiles. `false`: its frame is too old.
   *
   * @param at the batch's sample, in points' room, at which the packet's begin
   */
  take(batch: Batch, packet: number, at: number, nowMs: number): boolean {
    this.#follow(batch, packet);
    const { map } = this;
    const first = batch.firstTile(packet);
    const end = Math.min(first + batch.tilesOf(packet), map.slots.length);
    const before = map.newestFrame;
    const slot = map.open(batch.frameNumber(packet), end / map.slots.length, nowMs);
    if (slot === null) return false;
    if (map.newestFrame !== before) {
      const { tilePosition, tileOrientation } = this.#uniforms;
      writePose(batch, packet, tilePosition.value[slot]!, 0, tileOrientation.value[slot]!);
      this.paint.begin(slot, batch.captureTimeUs(packet));
    }
    const { samples } = batch;
    let run = first;
    for (let tile = first; tile < end; tile++) {
      const from = (at + (tile - first) * TILE_ROOM) * 2;
      if (map.show(tile, slot, isEmpty(samples, from))) continue;
      this.#write(samples, at, first, run, tile);
      run = tile + 1;
    }
    this.#write(samples, at, first, run, end);
    map.count(slot, batch.pointsCame(packet), pointsOfBytes(batch.frameLength(packet)));
    this.#changed = true;
    return true;
  }

  /** Call it before each rendering. */
  update(nowMs: number): void {
    const { map } = this;
    this.visible = map.shown > 0;
    if (!this.visible) return;
    setFeatures(this.material, featuresOf(this.#points));
    if (this.#changed) this.#textures?.writeSlots(map.slots);
    this.#changed = false;
    this.paint.update(nowMs);
    const { value } = this.#uniforms.tilePosition;
    for (let slot = 0; slot < FRAME_SLOTS; slot++) value[slot]!.w = (nowMs - map.beganMs(slot)) / 1000;
  }

  /** Discards what is drawn. */
  forget(): void {
    this.map.reset();
    this.paint.forget();
    this.visible = false;
  }

  /** A lost GPU context was restored. */
  recreate(): void {
    this.#textures?.recreate();
    this.paint.recreate();
    this.forget();
  }

  /** Frees the GPU's memory. */
  override dispose(): void {
    this.#textures?.dispose();
    this.paint.dispose();
    this.geometry.dispose();
    this.material.dispose();
  }

  /** Does nothing, as for points. */
  override raycast(): void {}

  #write(samples: Uint32Array, at: number, first: number, from: number, end: number): void {
    if (end <= from) return;
    this.#textures?.write(samples, (at + (from - first) * TILE_ROOM) * 2, from, end - from);
  }

  /** Begins anew if the image or the camera is another. */
  #follow(batch: Batch, packet: number): void {
    const [grid, given] = [this.#grid, this.#given];
    batch.readGrid(packet, given);
    const same = grid.width === given.width && grid.height === given.height && grid.fx === given.fx;
    if (same && grid.fy === given.fy && grid.cx === given.cx && grid.cy === given.cy) return;
    Object.assign(grid, given);
    const [columns, rows] = [Math.ceil(grid.width / TILE), Math.ceil(grid.height / TILE)];
    this.#textures?.dispose();
    const textures = new TileTextures(this.#renderer, columns * rows);
    this.#textures = textures;
    this.map = new TileMap(columns * rows);
    const { tileGrid, lens, tileSamples, tileSlots } = this.#uniforms;
    tileGrid.value.set([columns, rows, textures.perRow]);
    lens.value.set(grid.fx, grid.fy, grid.cx, grid.cy);
    tileSamples.value = textures.samples;
    tileSlots.value = textures.slots;
    this.geometry.instanceCount = columns * rows;
    this.paint.follow(grid.width, grid.height);
  }
}

/** Whether nothing was seen in a tile. */
function isEmpty(samples: Uint32Array, from: number): boolean {
  for (let i = from; i < from + TILE_SAMPLES; i++) if (samples[i] !== 0) return false;
  return true;
}
