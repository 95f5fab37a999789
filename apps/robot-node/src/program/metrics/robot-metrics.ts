import { PulledMetrics, type Registry } from '@farpoint/service';
import { addDriveMetrics, addGuardMetrics } from './drive-metrics.ts';
import type { MeasuredRobot } from './measured-robot.ts';
import { addPathMetrics, addSensorMetrics } from './path-metrics.ts';
import { addLiveMetrics, addRecordingMetrics } from './recording-metrics.ts';
import {
  addBroadcastMetrics,
  addReferenceMetrics,
  addSessionMetrics,
  addSignalingMetrics,
} from './session-metrics.ts';
import { addDeviceMetrics, addPictureMetrics, addSoundMetrics, addVideoMetrics } from './video-metrics.ts';

/** Registers all of the robot's counts for `/metrics`. */
export function registerRobotMetrics(registry: Registry, robot: MeasuredRobot): void {
  const metrics = new PulledMetrics(registry, 'farpoint_robot');
  addSessionMetrics(metrics, robot);
  addSignalingMetrics(metrics, robot);
  addDriveMetrics(metrics, robot);
  addGuardMetrics(metrics, robot);
  addSensorMetrics(metrics, robot);
  addPathMetrics(metrics, robot);
  addPictureMetrics(metrics, robot);
  addVideoMetrics(metrics, robot);
  addSoundMetrics(metrics, robot);
  addDeviceMetrics(metrics, robot);
  addBroadcastMetrics(metrics, robot);
  addRecordingMetrics(metrics, robot);
  addLiveMetrics(metrics, robot);
  addReferenceMetrics(metrics, robot);
}
