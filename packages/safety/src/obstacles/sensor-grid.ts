/** What is known of a cell of the floor. The numbers are those of the sensors' grids. */
export const floorClasses = {
  /** No sensor has seen it. */
  unknown: 0,
  /** Its floor is there, and nothing stands on it. */
  free: 1,
  /** Something stands there that the robot would hit. */
  occupied: 2,
  /** Its floor is missing. */
  dropOff: 3,
} as const;

/**
 * How much wider the floor's band of heights becomes with each metre of distance. Chosen: a sensor that is mounted with
 * a tilt of half a degree sees an even floor as floor.
 */
export const FLOOR_SLOPE = 0.01;

/** Position and heading on the floor: metres, radians to the left of the x axis. */
export interface FloorPose {
  x: number;
  y: number;
  yaw: number;
}

/** What one cloud of one sensor says about the floor. */
export interface SensorGrid {
  /** When the cloud was taken, robot's clock, ms. */
  capturedAtMs: number;
  /**
   * Whether its cells lie along the axes of odometry. If not, they lie along base_link's axes, wherever that was when the
   * cloud was taken.
   */
  placed: boolean;
  /** Whether those who say where the sensor sits contradict each other: nobody knows where its cells lie. */
  disputed?: boolean;
  /** Cells along a side, and their length, metres. */
  side: number;
  cellM: number;
  /** Cell (i, j) is cell (firstX + i, firstY + j) of the plane, which begins at x = (firstX + i) · cellM. */
  firstX: number;
  firstY: number;
  /** {@link floorClasses} of cell (i, j) at `j * side + i`. A view that may be overwritten after the call. */
  classes: Uint8Array;
  /**
   * Of an occupied cell: up to where it must be seen to be empty, from the floor on, before its obstacle is gone. Of a free
   * cell: up to where the sensor had it in view. Any unit, the same for all sensors. Without heights, what is free is empty.
   */
  heights?: Uint8Array;
}
