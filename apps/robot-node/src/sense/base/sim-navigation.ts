/** What a navigator of the simulated robot would publish: the building's map, and a plan to a place. */
import type { Pose } from '@farpoint/protocol';
import { type FramePose, NavigationTopic, type TopicReading } from '@farpoint/ros';
import { type FloorPlan, floorPlan, WaysTo, type WorldDescription } from '@farpoint/sim';
import { SIM_MAP, SIM_PLAN } from './sim-topics.ts';

/** Side of the map's cells, metres. Chosen: twice the usual 0.05 m, for a quarter of the cells. */
const CELL_M = 0.1;
/** How far plans stay away from what stands there, metres: the robot's radius, and some. */
const CLEARANCE_M = 0.35;
/**
 * The map is published again after this long, as by a mapping robot, ms. Chosen: mapping programs do so every
 * few seconds.
 */
const MAP_MS = 5000;
/** The simulator's world is the world. */
const IN_WORLD: FramePose = () => ({
  position: { x: 0, y: 0, z: 0 },
  orientation: { x: 0, y: 0, z: 0, w: 1 },
});
const HEADER = { stamp: { sec: 0, nanosec: 0 }, frame_id: 'map' };
const AHEAD = { x: 0, y: 0, z: 0, w: 1 };

export interface SimNavigationOptions {
  /** Whether it has a map. */
  map: boolean;
  /** Where its plan leads, in the world, metres; `null`: it has none. */
  planTo: { x: number; y: number } | null;
}

export class SimNavigation {
  readonly #mapTopic = new NavigationTopic(SIM_MAP);
  readonly #planTopic = new NavigationTopic(SIM_PLAN);
  readonly #map: FloorPlan | null;
  readonly #ways: WaysTo | null;
  #mapMs = Number.NEGATIVE_INFINITY;

  constructor(world: WorldDescription, { map, planTo }: SimNavigationOptions) {
    const plan = map || planTo !== null ? floorPlan(world, CELL_M) : null;
    this.#map = map ? plan : null;
    this.#ways = plan === null || planTo === null ? null : new WaysTo(plan, planTo.x, planTo.y, CLEARANCE_M);
  }

  /** What is published now. Call it once a second. */
  readings({ position }: Pose, nowMs: number): TopicReading[] {
    const readings: TopicReading[] = [];
    if (this.#ways !== null) {
      const poses = this.#ways.from(position.x, position.y).map((place) => poseAt(place));
      readings.push(this.#planTopic.take({ header: HEADER, poses }, IN_WORLD));
    }
    if (this.#map !== null && nowMs - this.#mapMs >= MAP_MS) {
      this.#mapMs = nowMs;
      const { width, height, cellM, data } = this.#map;
      const info = { width, height, resolution: cellM, origin: poseAt(this.#map).pose };
      readings.push(this.#mapTopic.take({ header: HEADER, info, data }, IN_WORLD));
    }
    return readings;
  }
}

function poseAt({ x, y }: { x: number; y: number }) {
  return { pose: { position: { x, y, z: 0 }, orientation: AHEAD } };
}
