/** What a sensor's whole cloud says about the floor around the robot. */
import { ObstacleGrid as Binding } from '../pkg/farpoint_codec.js';
import type { Codec } from './codec.ts';
import { CodecError } from './errors.ts';
import type { Pinhole } from './organised-encoder.ts';
import { checkCapacity } from './slot-layout.ts';

/** What a cloud says about a cell, as {@link ObstacleGrid.classes} has it. */
export const cellClasses = {
  /** Nothing was seen there. */
  unknown: 0,
  /** Its floor was seen, or a ray passed low over it, and nothing stands there. */
  free: 1,
  /** Something stands there that the robot would hit. */
  occupied: 2,
  /** Its floor is missing: what was seen through it lies below the floor. */
  dropOff: 3,
} as const;

/** Steps of {@link ObstacleGrid.heights}, metres. */
export const HEIGHT_STEP_M = 0.02;

/** How a cloud is judged. Lengths in metres. */
export interface ObstacleGridSettings {
  /** Cells along a side, an even number from 2 to 1024. */
  side: number;
  /** Length of a cell. */
  cellM: number;
  /** What is lower than this is floor. */
  clearanceM: number;
  /** What is higher than this is passed under. */
  heightM: number;
  /** What is lower than this below the floor is no floor. */
  dropM: number;
  /** How much wider the floor's band becomes with each metre of distance. */
  slope: number;
  /** A ray that passes no higher than this over a cell shows that it is free. */
  lowRayM: number;
  /** How many points make an obstacle at one metre. Fewer do at a distance, by its square. */
  nearPoints: number;
  /** How many points make an obstacle at any distance. */
  leastPoints: number;
  /** An obstacle counts once a second cloud has it in the same or a neighbouring cell. */
  confirm: boolean;
}

/** How many cells a cloud left in each class. */
export interface SeenCells {
  free: number;
  occupied: number;
  dropOffs: number;
}

/** Rotation row by row (9 numbers), then position (3), metres. */
const POSE_LENGTH = 12;

/**
 * Judges clouds one by one: fill {@link points} (or {@link depth}) and {@link pose}, call {@link look}, read
 * {@link classes}. Allocates nothing for a cloud. Views are recreated when the module's memory has grown: take them for
 * each cloud and do not keep them.
 */
export class ObstacleGrid implements Disposable {
  readonly capacity: number;
  readonly settings: Readonly<ObstacleGridSettings>;
  readonly #memory: Codec['memory'];
  readonly #binding: Binding;
  #pixels = 0;

  /**
   * @param capacity most points of a cloud
   * @throws CodecError `bad-capacity`, `bad-parameter`
   */
  constructor(codec: Codec, capacity: number, settings: ObstacleGridSettings) {
    checkCapacity('capacity', capacity);
    const { side, cellM, clearanceM, heightM, dropM, slope, lowRayM } = settings;
    const { nearPoints, leastPoints, confirm } = settings;
    // WASM would cut a fraction off.
    const whole = Number.isInteger(side) && side > 0;
    const binding = whole
      ? Binding.create(
          capacity,
          side,
          cellM,
          clearanceM,
          heightM,
          dropM,
          slope,
          lowRayM,
          nearPoints,
          leastPoints,
          confirm,
        )
      : undefined;
    if (binding === undefined) {
      throw new CodecError('bad-parameter', `no grid has these settings: ${JSON.stringify(settings)}`);
    }
    this.capacity = capacity;
    this.settings = { ...settings };
    this.#memory = codec.memory;
    this.#binding = binding;
  }

  /** The camera of the images. @throws CodecError `bad-parameter` if it is none, or has more pixels than the capacity */
  setCamera({ width, height }: { width: number; height: number }, { fx, fy, cx, cy }: Pinhole): void {
    const whole = [width, height].every((side) => Number.isInteger(side) && side > 0);
    if (!whole || !this.#binding.set_camera(width, height, fx, fy, cx, cy)) {
      throw new CodecError('bad-parameter', `no camera of ${width} × ${height} pixels has these numbers`);
    }
    this.#pixels = width * height;
  }

  /** Metres along the optical axis, row by row; 0, negative or not finite where there is none. */
  get depth(): Float32Array {
    return new Float32Array(this.#memory.buffer, this.#binding.depth_ptr(), this.#pixels);
  }

  /** 4 floats per point: x, y, z in metres in the sensor's optical frame; the fourth is not read. */
  get points(): Float32Array {
    // First the place: making room may move the memory.
    const place = this.#binding.points_ptr();
    return new Float32Array(this.#memory.buffer, place, this.capacity * 4);
  }

  /** The sensor's pose in the grid's frame (x forward, y left, z up from the floor): rotation row by row, position. */
  get pose(): Float32Array {
    return new Float32Array(this.#memory.buffer, this.#binding.pose_ptr(), POSE_LENGTH);
  }

  /**
   * Judges the image, or the first `points` points.
   *
   * @param shift by how many cells the grid has moved along x and y since the last cloud
   * @throws CodecError `bad-parameter` for a pose that is none, `too-many-points`
   */
  look(cloud: 'image' | { points: number }, shift: readonly [number, number] = [0, 0]): SeenCells {
    const image = cloud === 'image';
    const points = image ? 0 : cloud.points;
    if (!Number.isInteger(points) || points < 0) {
      throw new CodecError('bad-count', `${points} points: not a whole number from 0 on`);
    }
    const fault = this.#binding.look(image, points, shift[0], shift[1]);
    if (fault === 2) throw new CodecError('too-many-points', `${points} points: more than the capacity`);
    if (fault !== 0) {
      throw new CodecError('bad-parameter', fault === 1 ? 'the pose is none' : 'no camera has been set');
    }
    const report = new Uint32Array(this.#memory.buffer, this.#binding.report_ptr(), 3);
    const [free, occupied, dropOffs] = report as unknown as [number, number, number];
    return { free, occupied, dropOffs };
  }

  /**
   * The class of each cell ({@link cellClasses}): cell (i, j) is at `j * side + i` and begins at x = (i − side / 2) ·
   * cell, y = (j − side / 2) · cell.
   */
  get classes(): Uint8Array {
    const { side } = this.settings;
    return new Uint8Array(this.#memory.buffer, this.#binding.classes_ptr(), side * side);
  }

  /**
   * Of an occupied cell: up to where it must be seen to be empty, from the floor on, before its obstacle is gone. Of a free
   * cell: up to where it was in view. In steps of {@link HEIGHT_STEP_M}; 255: or higher. Of other cells, any number.
   */
  get heights(): Uint8Array {
    const { side } = this.settings;
    return new Uint8Array(this.#memory.buffer, this.#binding.heights_ptr(), side * side);
  }

  /** Frees the memory; the grid and its views must not be used afterwards. */
  [Symbol.dispose](): void {
    this.#binding.free();
  }
}
