import { PulledMetrics, type Registry } from '@farpoint/service';
import { addBroadcastMetrics } from './broadcast-metrics.ts';
import { addDriveMetrics } from './drive-metrics.ts';
import { addGuardMetrics } from './guard-metrics.ts';
import { addLiveMetrics } from './live-metrics.ts';
import type { MeasuredRobot } from './measured-robot.ts';
import { addPathMetrics } from './path-metrics.ts';
import { addPictureMetrics } from './picture-metrics.ts';
import { addRecordingMetrics } from './recording-metrics.ts';
import { addReferenceMetrics } from './reference-metrics.ts';
import { addSensorMetrics } from './sensor-metrics.ts';
import { addSessionMetrics } from './session-metrics.ts';
import { addSignalingMetrics } from './signaling-metrics.ts';
import { addSoundMetrics } from './sound-metrics.ts';
import { addVideoMetrics } from './video-metrics.ts';

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
  addBroadcastMetrics(metrics, robot);
  addRecordingMetrics(metrics, robot);
  addLiveMetrics(metrics, robot);
  addReferenceMetrics(metrics, robot);
}
