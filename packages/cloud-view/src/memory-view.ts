/**
 * What is remembered, on the GPU: takes changed pages as they come, and draws those that are in view, in one call.
 * Allocates nothing in the frame loop.
 */
import { MEMORY_LAYOUT, type MemoryListener, type MemoryPages, type WorldMemory } from '@farpoint/operator';
import {
  type Camera,
  Frustum,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Matrix4,
  Points,
  type RawShaderMaterial,
  Sphere,
  Vector3,
  type WebGLRenderer,
} from 'three';
import type { HeightCut } from './cloud-colouring.ts';
import { type Hazards, setHazards } from './hazards.ts';
import { createMemoryMaterial } from './memory-material.ts';
import { MemoryTexture } from './memory-texture.ts';
import { viewportHeightOf } from './renderer-facts.ts';
import { featuresOf, setFeatures, UNLIMITED_M } from './shader-features.ts';

const { pages: PAGES, pageSurfels, chunkM, ageUnitS, clockStartS } = MEMORY_LAYOUT;
const PLACE = 4;
/** Half of a chunk's diagonal, and what a headset may turn between two pictures, metres. */
const RADIUS_M = (chunkM * Math.sqrt(3)) / 2 + 0.5;

/** What a view needs of a {@link WorldMemory}. */
export type MemorySource = Pick<WorldMemory, 'listener' | 'nowS' | 'resend'>;

/**
 * The remembered world as an object of a three.js scene; add it to a {@link RobotWorld}. It is dimmer and greyer than
 * the live clouds, which hide it where they are. Call {@link update} before each rendering.
 */
export class MemoryView extends Points<InstancedBufferGeometry, RawShaderMaterial> implements MemoryListener {
  /** Heights between which points are drawn, metres above {@link ground}. */
  cut: Readonly<HeightCut> = { below: null, above: null };
  /** Height of the robot's ground in its world, metres. */
  ground = 0;
  /** What is tinted as a hazard; `null`, the default: nothing. */
  hazards: Hazards | null = null;
  /** Whether anything is drawn. */
  enabled = true;
  /** Number of points in view. */
  drawn = 0;
  /** How long ago the oldest of them was seen, seconds; `null` while nothing is in view. */
  oldestS: number | null = null;
  readonly #renderer: WebGLRenderer;
  readonly #memory: MemorySource;
  readonly #texture: MemoryTexture;
  readonly #uniforms: ReturnType<typeof createMemoryMaterial>['uniforms'];
  /** By page: its chunk, and its number and, from bit 16 on, its surfels. */
  readonly #places = new Int32Array(PAGES * PLACE);
  readonly #oldest = new Uint16Array(PAGES);
  readonly #inView = new InstancedBufferAttribute(new Int32Array(PAGES * PLACE), PLACE);
  /** The number after the highest page that has ever come. */
  #end = 0;
  readonly #frustum = new Frustum();
  readonly #matrix = new Matrix4();
  readonly #sphere = new Sphere(new Vector3(), RADIUS_M);
  readonly #stop: () => void;

  /**
   * @param renderer the only renderer that draws this object
   * @param memory whose pages are drawn; this object becomes its listener
   */
  constructor(renderer: WebGLRenderer, memory: MemorySource) {
    const texture = new MemoryTexture(renderer);
    const { material, uniforms } = createMemoryMaterial(texture.texture);
    super(new InstancedBufferGeometry(), material);
    this.#renderer = renderer;
    this.#memory = memory;
    this.#texture = texture;
    this.#uniforms = uniforms;
    this.geometry.setAttribute('place', this.#inView);
    this.geometry.setDrawRange(0, pageSurfels);
    this.geometry.boundingSphere = new Sphere(new Vector3(), Number.POSITIVE_INFINITY);
    this.frustumCulled = false;
    this.visible = false;
    // After the live clouds: what they hide is not shaded.
    this.renderOrder = 1;
    const recreate = () => {
      texture.recreate();
      memory.resend();
    };
    renderer.domElement.addEventListener('webglcontextrestored', recreate);
    this.#stop = () => renderer.domElement.removeEventListener('webglcontextrestored', recreate);
    memory.listener = this;
  }

  /** Writes changed pages to the GPU. */
  onPages(pages: MemoryPages): void {
    for (let i = 0; i < pages.count; i++) {
      const page = pages.page(i);
      const surfels = pages.surfels(i);
      this.#texture.write(page, pages.words, pages.surfelsAt(i), surfels);
      for (let axis = 0; axis < 3; axis++) this.#places[page * PLACE + axis] = pages.chunk(i, axis);
      this.#places[page * PLACE + 3] = page | (surfels << 16);
      this.#oldest[page] = pages.oldest(i);
      this.#end = Math.max(this.#end, page + 1);
    }
  }

  /** Draws nothing until new pages come. */
  onForgotten(): void {
    this.#places.fill(0);
    this.#end = 0;
  }

  /** Finds what is in view. Call it before each rendering, after the camera was placed. */
  update(camera: Camera): void {
    const { xr } = this.#renderer;
    // In VR, of the picture before: both eyes together.
    const eye = xr.isPresenting ? xr.getCamera() : camera;
    if (!xr.isPresenting) eye.updateWorldMatrix(true, false);
    this.#matrix.multiplyMatrices(eye.projectionMatrix, eye.matrixWorldInverse);
    this.#frustum.setFromProjectionMatrix(this.#matrix);
    const oldest = this.enabled ? this.#collect() : 0;
    const now = (this.#memory.nowS + clockStartS) / ageUnitS;
    this.visible = this.drawn > 0 && this.enabled;
    this.oldestS = this.visible ? Math.max(now - oldest, 0) * ageUnitS : null;
    if (!this.visible) return;
    const { ground, cut } = this;
    this.#uniforms.nowUnits.value = now;
    this.#uniforms.heightCut.value.set(
      cut.below === null ? -UNLIMITED_M : ground + cut.below,
      cut.above === null ? UNLIMITED_M : ground + cut.above,
    );
    setHazards(this.#uniforms, this.hazards);
    setFeatures(this.material, featuresOf(this.#uniforms));
    this.#uniforms.viewportHeight.value = viewportHeightOf(this.#renderer);
  }

  /** Frees the GPU's memory. */
  override dispose(): void {
    this.#stop();
    if (this.#memory.listener === this) this.#memory.listener = null;
    this.removeFromParent();
    this.geometry.dispose();
    this.material.dispose();
    this.#texture.dispose();
  }

  /** Does nothing: the points exist only on the GPU, so rays cannot hit them. */
  override raycast(): void {}

  /** Collects the pages in view. @returns the oldest unit of age among them */
  #collect(): number {
    const places = this.#places;
    const inView = this.#inView.array;
    const { center } = this.#sphere;
    let found = 0;
    let oldest = 0xffff;
    this.drawn = 0;
    for (let page = 0; page < this.#end; page++) {
      const at = page * PLACE;
      const surfels = (places[at + 3] as number) >> 16;
      if (surfels === 0) continue;
      const [x, y, z] = [places[at] as number, places[at + 1] as number, places[at + 2] as number];
      center.set((x + 0.5) * chunkM, (y + 0.5) * chunkM, (z + 0.5) * chunkM).applyMatrix4(this.matrixWorld);
      if (!this.#frustum.intersectsSphere(this.#sphere)) continue;
      for (let i = 0; i < PLACE; i++) inView[found * PLACE + i] = places[at + i] as number;
      oldest = Math.min(oldest, this.#oldest[page] as number);
      this.drawn += surfels;
      found++;
    }
    this.geometry.instanceCount = found;
    this.#inView.clearUpdateRanges();
    this.#inView.addUpdateRange(0, found * PLACE);
    this.#inView.needsUpdate = found > 0;
    return oldest;
  }
}
