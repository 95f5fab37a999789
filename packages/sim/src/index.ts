export type { BatteryState } from './battery.ts';
export {
  type CameraOptions,
  DEFAULT_CAMERA,
  depthToMillimetres,
  FLOOR_CAMERAS,
  type Images,
  type WasmSource,
} from './camera.ts';
export { type ComponentState, componentStates } from './component-states.ts';
export { DEFAULT_LIMITS, type RobotLimits } from './drive.ts';
export { SimulationError, type SimulationErrorCode } from './errors.ts';
export { type FloorPlan, floorPlan, WaysTo } from './floor-plan.ts';
export { type EarthOrigin, earthPlace } from './gnss.ts';
export { SIM_WHEEL_JOINTS, simUrdf } from './robot-urdf.ts';
export { type BaseState, SimulatedBase, TIME_STEP } from './simulated-base.ts';
export { type CloudFrame, type RenderOptions, SimulatedCamera } from './simulated-camera.ts';
export { DEFAULT_LIDAR, type LidarOptions, type LidarTurn, SimulatedLidar } from './simulated-lidar.ts';
export { type RobotState, Simulation, type SimulationOptions } from './simulation.ts';
export type { Box, Ellipsoid, Hole, Material, Mover, Panel, PlanarPose, WorldDescription } from './world.ts';
export { readSnapshot, snapshotNumbers, type WorldSnapshot, writeSnapshot } from './world-snapshot.ts';
export { concourseWorld } from './worlds/concourse.ts';
export { dockWorld } from './worlds/dock.ts';
export { officeWorld } from './worlds/office.ts';
export { THING_SIZE, type Thing, withThings } from './worlds/things.ts';
export { warehouseWorld } from './worlds/warehouse.ts';
