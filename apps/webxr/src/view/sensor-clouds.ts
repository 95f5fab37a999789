/** The clouds of a robot with several sensors: which are wanted, and the objects that draw all but the first one's. */
import { CloudView } from '@farpoint/cloud-view';
import type { RobotClient } from '@farpoint/operator';
import type { Object3D, WebGLRenderer } from 'three';

/**
 * Points of other sensors, beside what the first one's would be: they are few and far apart, and as large as their distances
 * they would hide what it shows.
 */
const SIZE_BESIDE_FIRST = 0.2;

export interface SensorCloud {
  readonly sensor: number;
  readonly name: string;
  wanted: boolean;
}

export interface SensorCloudsParts {
  renderer: WebGLRenderer;
  /** Where clouds are drawn. */
  world: Object3D;
  client: RobotClient;
  /** Draws the first sensor's. */
  first: CloudView;
  /** Other sensors, or others of them wanted. */
  onChange(): void;
}

export class SensorClouds {
  /** Empty for a robot with one sensor. */
  sensors: readonly SensorCloud[] = [];
  readonly #parts: SensorCloudsParts;
  /** By sensor number. */
  readonly #views = new Map<number, CloudView>();
  /** Of whichever robot: what somebody has switched off stays off. */
  readonly #unwanted = new Set<string>();
  #sizeScale = 1;

  constructor(parts: SensorCloudsParts) {
    this.#parts = parts;
  }

  /** The robot has told of its sensors; with an empty list, a session begins or ends. */
  setSensors(names: readonly { name: string }[]): void {
    for (const [sensor, view] of this.#views) if (sensor > 0) view.dispose();
    this.#views.clear();
    const { renderer, world, client, first, onChange } = this.#parts;
    this.sensors = names.map(({ name }, sensor) => ({ sensor, name, wanted: !this.#unwanted.has(name) }));
    for (const { sensor } of this.sensors) {
      const view = sensor === 0 ? first : new CloudView(renderer, client, { sensor });
      this.#views.set(sensor, view);
      if (sensor > 0) {
        view.sizeScale = this.#sizeScale * SIZE_BESIDE_FIRST;
        world.add(view);
      }
    }
    if (this.sensors.length > 0) this.#want();
    onChange();
  }

  /** One that is switched off costs the link nothing, and nothing of it is shown. */
  toggle(cloud: SensorCloud): void {
    cloud.wanted = !cloud.wanted;
    if (cloud.wanted) this.#unwanted.delete(cloud.name);
    else this.#unwanted.add(cloud.name);
    this.#want();
    this.#parts.onChange();
  }

  /** As {@link CloudView.sizeScale}, of all but the first. */
  set sizeScale(scale: number) {
    this.#sizeScale = scale;
    for (const [sensor, view] of this.#views) {
      if (sensor > 0) view.sizeScale = scale * SIZE_BESIDE_FIRST;
    }
  }

  /** In the frame loop, before rendering. */
  update(nowMs: number): void {
    for (const { sensor, wanted } of this.sensors) {
      const view = this.#views.get(sensor);
      // What was on its way when it was switched off is not shown either.
      if (!wanted) view?.forget();
      else if (sensor > 0) view?.update(nowMs);
    }
  }

  /** Points that one sensor's view draws. */
  drawnOf(sensor: number): number {
    return this.#views.get(sensor)?.drawn ?? 0;
  }

  #want(): void {
    this.#parts.client.wantClouds(this.sensors.flatMap(({ sensor, wanted }) => (wanted ? [sensor] : [])));
  }
}
