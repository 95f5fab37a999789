/** How much wider the floor's band of heights becomes with each metre of distance: a tilt of half a degree. */
export const FLOOR_SLOPE = 0.01;
