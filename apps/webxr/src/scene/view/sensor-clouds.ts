/** Draws the clouds of a robot with several sensors, except the first sensor's, which has an object of its own. */
import { type CloudSource, CloudView, strideFor } from '@farpoint/cloud-view';
import { effect, type ReadonlySignal, signal } from '@preact/signals-core';
import type { Object3D, WebGLRenderer } from 'three';
import type { Switches } from '../../ground/switches.ts';

/**
 * Size of other sensors' points, relative to the first sensor's. Their points are few and far apart. Drawn as large
 * as their spacing, they would hide the first sensor's cloud.
 */
const SIZE_BESIDE_FIRST = 0.2;

export interface SensorCloudsParts {
  readonly renderer: WebGLRenderer;
  /** The object that the clouds are added to. */
  readonly world: Object3D;
  readonly client: CloudSource;
  /** Draws the first sensor's cloud. */
  readonly first: CloudView;
  /** Empty for a robot with one sensor. */
  readonly sensors: Switches;
  readonly pointScale: ReadonlySignal<number>;
}

export class SensorClouds {
  readonly #parts: SensorCloudsParts;
  /** Indexed by sensor number. */
  #views: readonly CloudView[] = [];
  readonly #all = signal<readonly CloudView[]>([]);
  #ground = 0;
  #every = 1;

  constructor(parts: SensorCloudsParts) {
    this.#parts = parts;
    const { sensors, pointScale } = parts;
    effect(() => this.#build(sensors.all.value.length));
    effect(() => this.#scale(pointScale.value));
  }

  /** What draws each sensor's cloud, by sensor number; also for a robot with one sensor. */
  get all(): ReadonlySignal<readonly CloudView[]> {
    return this.#all;
  }

  /** Height of the robot's ground in its world, metres. */
  set ground(height: number) {
    this.#ground = height;
    for (const { colouring } of this.#all.peek()) colouring.ground = height;
  }

  /** Draws about one of this many samples of surfaces. */
  set every(every: number) {
    this.#every = every;
    for (const view of this.#all.peek()) view.every = every;
  }

  /** Of how many points about one is drawn if one of `every` is wanted. */
  drawnOneOf(every: number): number {
    return this.#parts.first.isSurface ? strideFor(every) ** 2 : every;
  }

  /** Call this in the frame loop, before rendering. */
  update(nowMs: number): void {
    for (const { index, on } of this.#parts.sensors.all.peek()) {
      // Points that were on their way when the sensor was switched off are not shown either.
      if (!on.peek()) this.#views[index]?.forget();
      else if (index > 0) this.#views[index]?.update(nowMs);
    }
  }

  /** Number of points that the view of this sensor draws. */
  drawnOf(sensor: number): number {
    return this.#views[sensor]?.drawn ?? 0;
  }

  #build(sensors: number): void {
    const { renderer, world, client, first, pointScale } = this.#parts;
    for (const view of this.#views.slice(1)) view.dispose();
    const others = Array.from(
      { length: Math.max(sensors - 1, 0) },
      (_, index) => new CloudView(renderer, client, { sensor: index + 1 }),
    );
    for (const view of others) world.add(view);
    this.#views = sensors === 0 ? [] : [first, ...others];
    this.#all.value = [first, ...others];
    this.ground = this.#ground;
    this.every = this.#every;
    this.#scale(pointScale.peek());
  }

  #scale(scale: number): void {
    for (const view of this.#views.slice(1)) view.sizeScale = scale * SIZE_BESIDE_FIRST;
  }
}
