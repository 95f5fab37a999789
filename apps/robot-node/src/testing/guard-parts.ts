/** What an obstacle guard sees by, for robots in virtual time. */

export { GRID_SHAPE } from '../motion/obstacles/guarded-sensors.ts';
export { CloudGuard } from '../sense/obstacles/cloud-guard.ts';
export { makeSharedGrid, SharedGridReader } from '../sense/obstacles/shared-grid.ts';
export { opticalMount } from '../sense/sources/sensor-mount.ts';
