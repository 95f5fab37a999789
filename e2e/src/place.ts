/** Metres, from the sensor: ahead, to the left, up. */
export type Place = readonly [x: number, y: number, z: number];
