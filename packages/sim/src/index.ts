export type { BatteryState } from './battery.ts';
export {
  type CameraOptions,
  DEFAULT_CAMERA,
  depthToMillimetres,
  type Images,
  type WasmSource,
} from './camera.ts';
export { DEFAULT_LIMITS, type RobotLimits } from './drive.ts';
export { SimulationError, type SimulationErrorCode } from './errors.ts';
export {
  type CloudFrame,
  type RobotState,
  Simulation,
  type SimulationOptions,
  TIME_STEP,
} from './simulation.ts';
export type { Box, Ellipsoid, Material, Mover, Panel, PlanarPose, WorldDescription } from './world.ts';
export { officeWorld } from './worlds/office.ts';
