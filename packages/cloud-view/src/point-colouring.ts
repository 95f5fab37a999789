/** Sets the shader's uniforms for a cloud's colours, and follows the range of values in view from a few samples. */

import type { Quaternion } from '@farpoint/operator';
import { MAX_RINGS } from '@farpoint/protocol';
import { AutoRange } from './auto-range.ts';
import {
  type CloudColouring,
  COLOUR_MODES,
  type ColourMode,
  type HeightCut,
  type Rings,
  type ValueRange,
} from './cloud-colouring.ts';
import { type Hazards, setHazards } from './hazards.ts';
import type { PointUniforms } from './point-material.ts';
import { elevationOf, intensityOf, turnedZ } from './point-values.ts';
import { RingEstimator } from './ring-estimate.ts';
import { fillRingTable, ringScale } from './ring-table.ts';
import { SceneEstimate } from './scene-estimate.ts';
import { UNLIMITED_M } from './shader-features.ts';

/**
 * Number of points of a frame whose values are looked at. Chosen: a few microseconds of the main thread
 * (docs/page.md).
 */
const SAMPLES_PER_FRAME = 200;
/** No automatic range is narrower, in the mode's unit. */
const LEAST_SPAN: Readonly<Record<ColourMode, number>> = {
  captured: 1,
  height: 0.5,
  distance: 1,
  intensity: 0.1,
  age: 0.01,
  ring: 1,
  lit: 1,
};
/** The upper end of the automatic range, which begins at 0, until points have come. */
const FIRST_MAX: Readonly<Record<ColourMode, number>> = {
  captured: 1,
  height: 2,
  distance: 10,
  intensity: 1,
  age: 1,
  ring: 1,
  lit: 1,
};
/**
 * A coordinate's step moves a point's elevation by less than this, or the point says nothing about rings,
 * radians. 0.23°: the rings of a LiDAR with 128 are 0.35° apart
 * (docs/decisions/2026-11-23-rings-by-elevation.md).
 */
const MOST_STEP_RAD = 0.004;
/** Frame interval until it is known, and the longest that counts as one, s. */
const FIRST_INTERVAL_S = 0.1;
const MAX_INTERVAL_S = 2;
/** Weight of the latest frame interval in the running mean. */
const SMOOTHING = 0.1;
/** Points are dimmest at this age, frame intervals. They start to dim at one. */
const OLD_INTERVALS = 3;

export class PointColouring implements CloudColouring {
  fixedRange: ValueRange | null = null;
  ground = 0;
  cut: Readonly<HeightCut> = { below: null, above: null };
  hazards: Hazards | null = null;
  readonly range: ValueRange = { min: 0, max: 1 };
  readonly scene = new SceneEstimate();
  readonly #uniforms: PointUniforms;
  readonly #auto = new AutoRange();
  readonly #estimator = new RingEstimator();
  #knownRings: readonly number[] | null = null;
  #rings: Rings | null = null;
  readonly #beganMs = [0, 0];
  #newestSlot = 0;
  #intervalS = FIRST_INTERVAL_S;
  #mode: ColourMode = 'captured';
  #stride = 1;
  /** Points until the next sample. */
  #skip = 0;

  constructor(uniforms: PointUniforms) {
    this.#uniforms = uniforms;
  }

  get mode(): ColourMode {
    return this.#mode;
  }
  set mode(mode: ColourMode) {
    if (mode === this.#mode) return;
    this.#mode = mode;
    this.#forgetValues();
  }

  get knownRings(): readonly number[] | null {
    return this.#knownRings;
  }
  set knownRings(elevations: readonly number[] | null) {
    const usable = elevations !== null && elevations.length >= 2 && elevations.length <= MAX_RINGS;
    this.#knownRings = usable ? elevations : null;
    this.#useRings();
  }

  get rings(): Rings | null {
    return this.#rings;
  }

  /** A frame with `total` points begins to arrive. */
  beginFrame(slot: number, total: number, nowMs: number): void {
    const intervalS = (nowMs - (this.#beganMs[this.#newestSlot] as number)) / 1000;
    if (intervalS < MAX_INTERVAL_S) this.#intervalS += (intervalS - this.#intervalS) * SMOOTHING;
    this.#beganMs[slot] = nowMs;
    this.#newestSlot = slot;
    this.#stride = Math.max(1, Math.floor(total / SAMPLES_PER_FRAME));
  }

  /** Looks at a few of `count` points from point `first` on, which belong to the frame of this slot. */
  sample(points: Int16Array, first: number, count: number, slot: number): void {
    const looks = this.#looks;
    const unit = this.#uniforms.frameUnit.value[slot] as number;
    const position = this.#uniforms.framePosition.value[slot]!;
    const orientation = this.#uniforms.frameOrientation.value[slot]!;
    for (; this.#skip < count; this.#skip += this.#stride) {
      const at = (first + this.#skip) * 4;
      const [x, y, z] = [points[at] as number, points[at + 1] as number, points[at + 2] as number];
      this.scene.add(position, orientation, x * unit, y * unit, z * unit);
      if (!looks) continue;
      if (this.#mode === 'ring') this.#sampleRing(points, at);
      else this.#auto.add(this.#valueOf(points, at, unit, position.z, orientation));
    }
    this.#skip -= count;
  }

  /** Sets the uniforms for a display frame. */
  update(nowMs: number): void {
    const { range, fixedRange, ground, cut } = this;
    const auto = this.#auto;
    if (this.#mode === 'age') {
      range.min = this.#intervalS;
      range.max = this.#intervalS * OLD_INTERVALS;
    } else if (this.#mode === 'ring') {
      this.#useRings();
    } else {
      auto.update(nowMs, LEAST_SPAN[this.#mode]);
      range.min = auto.min;
      range.max = auto.max;
    }
    if (fixedRange !== null) {
      range.min = fixedRange.min;
      range.max = fixedRange.max;
    }
    const { colourMode, colourRange, groundHeight, heightCut, frameAge } = this.#uniforms;
    colourMode.value = COLOUR_MODES.indexOf(this.#mode);
    colourRange.value.set(range.min, 1 / Math.max(range.max - range.min, 1e-6));
    groundHeight.value = ground;
    heightCut.value.set(
      cut.below === null ? -UNLIMITED_M : ground + cut.below,
      cut.above === null ? UNLIMITED_M : ground + cut.above,
    );
    setHazards(this.#uniforms, this.hazards);
    this.scene.update(nowMs, this.#uniforms.framePosition.value[this.#newestSlot]!, ground);
    for (const slot of [0, 1]) frameAge.value[slot] = (nowMs - (this.#beganMs[slot] as number)) / 1000;
  }

  /** The points are discarded: the next ones may come from elsewhere. */
  forget(): void {
    this.scene.reset();
    this.#forgetValues();
  }

  #forgetValues(): void {
    this.#auto.reset(0, FIRST_MAX[this.#mode]);
    this.#estimator.reset();
  }

  /** Whether samples of points are of any use at present. */
  get #looks(): boolean {
    if (this.#mode === 'ring') return this.#knownRings === null;
    const hasRange = this.#mode === 'height' || this.#mode === 'distance' || this.#mode === 'intensity';
    return hasRange && this.fixedRange === null;
  }

  #sampleRing(points: Int16Array, at: number): void {
    const [x, y, z] = [points[at] as number, points[at + 1] as number, points[at + 2] as number];
    // In steps of a coordinate, a distance is the reciprocal of the angle of one step.
    if (Math.hypot(x, y, z) * MOST_STEP_RAD > 1) this.#estimator.add(elevationOf(x, y, z));
  }

  /** Brings the shader's table up to date. Estimates with as many rings as before change nothing: colours stay. */
  #useRings(): void {
    const from = this.#knownRings === null ? 'points' : 'robot';
    const elevations = this.#knownRings ?? this.#estimator.elevations;
    const before = this.#rings;
    if (elevations === (before?.elevations ?? null)) return;
    if (from === 'points' && before?.from === from && elevations?.length === before.elevations.length) return;
    this.#rings = elevations === null ? null : { elevations, from };
    const { ringMap, ringScale: scale } = this.#uniforms;
    if (elevations === null) {
      scale.value.set(0, 0);
      return;
    }
    const { from: lowest, texelsPerRadian } = ringScale(elevations);
    scale.value.set(lowest, texelsPerRadian);
    fillRingTable(elevations, ringMap.value.image.data as Uint8Array);
    ringMap.value.needsUpdate = true;
  }

  #valueOf(points: Int16Array, at: number, unit: number, sensorZ: number, orientation: Quaternion): number {
    if (this.#mode === 'intensity') return intensityOf((points[at + 3] as number) & 0xffff);
    const x = (points[at] as number) * unit;
    const y = (points[at + 1] as number) * unit;
    const z = (points[at + 2] as number) * unit;
    if (this.#mode === 'distance') return Math.hypot(x, y, z);
    return turnedZ(orientation, x, y, z) + sensorZ - this.ground;
  }
}
