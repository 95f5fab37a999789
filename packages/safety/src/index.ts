export * from './command-gate.ts';
export * from './drive-guard.ts';
export * from './estop.ts';
export * from './estop-release.ts';
export * from './geofence/index.ts';
export * from './lease.ts';
export * from './limits.ts';
export * from './motion/blind-travel.ts';
export * from './motion/collision-demand.ts';
export * from './motion/motion-guard.ts';
export * from './motion/motion-supervisor.ts';
export * from './motion/operator-view.ts';
export * from './motion/unattended-drive.ts';
export * from './motion/velocity-ramp.ts';
export * from './motion/view-age.ts';
export * from './obstacles/footprint.ts';
export * from './obstacles/obstacle-guard.ts';
export {
  defaultObstacleGuardOptions,
  type ObstacleGuardOptions,
} from './obstacles/obstacle-guard-options.ts';
export * from './obstacles/pose-track.ts';
export * from './obstacles/scan-grid.ts';
export * from './obstacles/sensor-grid.ts';
export * from './odometry/odometry.ts';
export * from './queueing-delay.ts';
export * from './rejection-reporter.ts';
export * from './return/return-drive.ts';
export { defaultReturnOptions, type ReturnOptions } from './return/return-options.ts';
export * from './robot-stop.ts';
export * from './watchdog.ts';
