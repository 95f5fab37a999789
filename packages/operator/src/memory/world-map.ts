/**
 * The remembered world: a map of the surfaces that the robot has seen, of bounded size. Time is an argument; nothing is
 * allocated after it was made, and the work of a call is bounded.
 *
 * A surfel is *confirmed*, and remembered, when it was seen again {@link CONFIRM_TICKS} or more after it was seen first, so
 * that what moves through is not. It is *carved* away where the robot now sees through it. When there is no room, the
 * chunk that is oldest and farthest away is forgotten.
 */
import { BETTER, CarvePass } from './carve-pass.ts';
import { FrameSamples } from './frame-samples.ts';
import type { KeyFrame } from './key-frame.ts';
import {
  CHUNK_M,
  CHUNK_STEPS,
  PAGE_SURFELS,
  PAGES,
  packPlace,
  STEPS_PER_METRE,
  TICKS_PER_S,
  ticksOf,
} from './memory-layout.ts';
import { type MotionLimits, PoseJump } from './pose-jump.ts';
import { SensorView } from './sensor-view.ts';
import { SurfelStore } from './surfel-store.ts';

/** A place must be seen this long after it was seen first, ticks. */
export const CONFIRM_TICKS = 10;
/** More sightings are not counted: so many times it must be seen through to be carved. */
export const MOST_SIGHTINGS = 8;
/**
 * What is farther away is not remembered, because its place is too uncertain, metres. A stereo camera's error
 * grows with the square of the distance: 2 mm/m² are 7 cm here, more than a voxel.
 */
export const MAX_RANGE_M = 6;
/** Steps of the distance from which a surfel was measured, metres. */
export const DISTANCE_STEP_M = 0.05;
/** When something must be forgotten, a metre counts as much as so many seconds. */
const SECONDS_PER_METRE = 10;

export interface WorldMapOptions {
  /** The most pages of 256 surfels; the default takes 42 MB. */
  pages?: number;
  limits?: MotionLimits;
}

/** What a frame changed. */
export interface FrameEffect {
  /** Samples that were taken. */
  samples: number;
  added: number;
  carved: number;
  /** Everything was forgotten before, because the pose had jumped. */
  jumped: boolean;
}

export class WorldMap {
  readonly store: SurfelStore;
  readonly jump: PoseJump;
  readonly #samples = new FrameSamples();
  readonly #view = new SensorView();
  readonly #carve: CarvePass;
  readonly #effect: FrameEffect = { samples: 0, added: 0, carved: 0, jumped: false };
  /** What was located last, and the coordinates of its chunk. */
  readonly #found = { chunk: -1, place: 0 };
  readonly #near = { x: Number.NaN, y: 0, z: 0 };
  #ticks = 0;
  /** Other sensors than the first may be LiDARs, whose intensities are no colours: they colour only what is new. */
  #recolours = true;

  constructor({ pages = PAGES, limits = { linear: 2, angular: 2 } }: WorldMapOptions = {}) {
    this.store = new SurfelStore(pages);
    this.jump = new PoseJump(limits);
    this.#carve = new CarvePass(this.store);
  }

  /** Forgets everything. */
  clear(): void {
    this.store.clear();
    this.jump.reset();
  }

  /** Takes a frame. What is returned is valid until the next call. */
  take(frame: KeyFrame): FrameEffect {
    const effect = this.#effect;
    effect.jumped = this.jump.isJump(frame);
    if (effect.jumped) this.store.clear();
    this.#ticks = ticksOf(frame.arrivedMs);
    this.#recolours = frame.sensor === 0;
    const samples = this.#samples;
    samples.read(frame);
    this.#view.set(frame, samples);
    effect.samples = samples.count;
    effect.added = this.#insert();
    effect.carved = this.#carve.run(this.#view, this.#ticks);
    return effect;
  }

  /**
   * Adds a surfel that was remembered before, unless its voxel has one or there is no room. Coordinates in metres.
   *
   * @param ticks when it was last seen
   */
  restore(x: number, y: number, z: number, colour: number, ticks: number): boolean {
    const { store } = this;
    const { chunk, place } = this.#locate(x, y, z, false);
    if (chunk < 0 || store.find(chunk, place) >= 0) return false;
    const surfel = store.add(chunk, place);
    if (surfel < 0) return false;
    store.colours[surfel] = colour;
    store.seen[surfel] = ticks;
    store.sightings[surfel] = 2;
    store.distances[surfel] = 255;
    store.chunkSeen[chunk] = Math.max(store.chunkSeen[chunk] as number, ticks);
    store.noteChange(Math.floor(surfel / PAGE_SURFELS));
    return true;
  }

  #insert(): number {
    const { position, rotation: r } = this.#view;
    const [px, py, pz] = [position[0] as number, position[1] as number, position[2] as number];
    const samples = this.#samples;
    let added = 0;
    for (let i = 0; i < samples.count; i++) {
      const range = samples.ranges[i] as number;
      if (range > MAX_RANGE_M) continue;
      const [x, y, z] = [samples.x[i] as number, samples.y[i] as number, samples.z[i] as number];
      const found = this.#locate(
        (r[0] as number) * x + (r[1] as number) * y + (r[2] as number) * z + px,
        (r[3] as number) * x + (r[4] as number) * y + (r[5] as number) * z + py,
        (r[6] as number) * x + (r[7] as number) * y + (r[8] as number) * z + pz,
        true,
      );
      if (found.chunk >= 0) added += this.#see(found.chunk, found.place, samples.colours[i] as number, range);
    }
    return added;
  }

  /** The chunk of a place, made if necessary; −1 where that is impossible. @param evict whether others may be forgotten */
  #locate(x: number, y: number, z: number, evict: boolean): { chunk: number; place: number } {
    const { store } = this;
    const found = this.#found;
    const [sx, sy, sz] = [
      Math.floor(x * STEPS_PER_METRE),
      Math.floor(y * STEPS_PER_METRE),
      Math.floor(z * STEPS_PER_METRE),
    ];
    const mask = CHUNK_STEPS - 1;
    const [cx, cy, cz] = [sx >> 10, sy >> 10, sz >> 10];
    found.place = packPlace(sx & mask, sy & mask, sz & mask);
    if (Math.abs(cx) >= 32_000 || Math.abs(cy) >= 32_000 || Math.abs(cz) >= 32_000) {
      found.chunk = -1;
      return found;
    }
    // Most samples lie in the same chunk as the one before.
    const near = this.#near;
    const { chunk } = found;
    const isSame = near.x === cx && near.y === cy && near.z === cz;
    if (isSame && chunk >= 0 && store.isChunk(chunk, cx, cy, cz)) return found;
    found.chunk = store.findChunk(cx, cy, cz);
    if (found.chunk < 0) {
      found.chunk = store.addChunk(cx, cy, cz);
      if (found.chunk < 0 && evict && this.#forgetOne()) found.chunk = store.addChunk(cx, cy, cz);
    }
    near.x = cx;
    near.y = cy;
    near.z = cz;
    return found;
  }

  /** Something was seen in a chunk. @returns 1 if it is new */
  #see(chunk: number, place: number, colour: number, range: number): number {
    const { store } = this;
    store.chunkSeen[chunk] = this.#ticks;
    const surfel = store.find(chunk, place);
    if (surfel >= 0) {
      this.#seeAgain(surfel, place, colour, range);
      return 0;
    }
    let added = store.add(chunk, place);
    if (added < 0 && this.#forgetOne()) added = store.add(chunk, place);
    if (added < 0) return 0;
    store.colours[added] = colour;
    store.seen[added] = this.#ticks;
    store.sightings[added] = 1;
    store.distances[added] = Math.min(Math.ceil(range / DISTANCE_STEP_M), 255);
    return 1;
  }

  #seeAgain(surfel: number, place: number, colour: number, range: number): void {
    const { store } = this;
    const since = this.#ticks - (store.seen[surfel] as number);
    const sightings = store.sightings[surfel] as number;
    const isConfirmed = sightings > 1;
    if (isConfirmed ? since === 0 : since < CONFIRM_TICKS) return;
    const page = Math.floor(surfel / PAGE_SURFELS);
    const distance = Math.min(Math.ceil(range / DISTANCE_STEP_M), 255);
    const isBetter = distance < BETTER * (store.distances[surfel] as number);
    // Whoever draws pages has these ages; a few seconds are not worth handing them on.
    if (!isConfirmed || isBetter || since > 4 * TICKS_PER_S) store.noteChange(page);
    const weight = isBetter ? 1 : sightings + 1;
    store.places[surfel] = towards(store.places[surfel] as number, place, weight);
    if (this.#recolours) store.colours[surfel] = colour;
    store.seen[surfel] = this.#ticks;
    store.sightings[surfel] = Math.min(sightings + 1, MOST_SIGHTINGS);
    store.distances[surfel] = Math.min(store.distances[surfel] as number, distance);
  }

  /** Makes room: forgets the chunk that is oldest and farthest away, but none that is seen now. */
  #forgetOne(): boolean {
    const { store } = this;
    const view = this.#view;
    let worst = -1;
    let most = 0;
    for (let chunk = 0; chunk < store.pages; chunk++) {
      if ((store.chunkPages[chunk] as number) < 0) continue;
      const age = (this.#ticks - (store.chunkSeen[chunk] as number)) / TICKS_PER_S;
      if (age <= 0) continue;
      const metres = view.distanceTo(
        ((store.chunkX[chunk] as number) + 0.5) * CHUNK_M,
        ((store.chunkY[chunk] as number) + 0.5) * CHUNK_M,
        ((store.chunkZ[chunk] as number) + 0.5) * CHUNK_M,
      );
      const score = age + SECONDS_PER_METRE * metres;
      if (score > most) [worst, most] = [chunk, score];
    }
    if (worst < 0) return false;
    store.removeChunk(worst);
    return true;
  }
}

/** A place a `weight`-th of the way to another one in the same voxel. */
function towards(from: number, to: number, weight: number): number {
  let place = 0;
  for (let shift = 0; shift < 30; shift += 10) {
    const a = (from >>> shift) & 1023;
    place |= Math.round(a + (((to >>> shift) & 1023) - a) / weight) << shift;
  }
  return place;
}
