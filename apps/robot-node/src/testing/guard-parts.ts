/** What an obstacle guard sees by, for robots in virtual time. */
export { CloudGuard } from '../obstacles/cloud-guard.ts';
export { GRID_SHAPE } from '../obstacles/guarded-sensors.ts';
export { opticalMount } from '../obstacles/sensor-mount.ts';
export { makeSharedGrid, SharedGridReader } from '../obstacles/shared-grid.ts';
