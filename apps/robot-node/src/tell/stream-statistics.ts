import type { TimedBaseState } from '@farpoint/cloud-source';
import type { RateSnapshot } from '@farpoint/congestion';
import type { RobotCounters } from '../ground/robot-counters.ts';
import type { TelemetryTarget } from './telemetry-sender.ts';

/** One operator's stream at one moment, for measurements. Totals count from the start of the session. */
export interface StreamStatistics extends RateSnapshot {
  session: string;
  /** Robot's clock (CLOCK_MONOTONIC where the system has it), ms. */
  timeMs: number;
  targetBitsPerSecond: number;
  bytesSent: number;
  packetsSent: number;
  framesSent: number;
  pointsSent: number;
  /** Frames that the pacer dropped, entirely or in part. */
  framesDropped: number;
  /** As planned for the last frame. */
  framesPerSecond: number;
  pointsPerFrame: number;
  /** Velocity of the robot's body, m/s and rad/s. */
  speed: number;
  turn: number;
}

export function streamStatistics(
  operators: Iterable<TelemetryTarget>,
  state: TimedBaseState | null,
  { lastFramesPerSecond, lastPoints }: RobotCounters,
  timeMs: number,
): StreamStatistics[] {
  const lines: StreamStatistics[] = [];
  for (const { id: session, sender, droppedFrames } of operators) {
    if (sender === null) continue;
    const { bytesSent, packetsSent, framesSent, pointsSent } = sender.counters;
    lines.push({
      session,
      timeMs,
      ...sender.rate,
      targetBitsPerSecond: sender.targetBitsPerSecond,
      bytesSent,
      packetsSent,
      framesSent,
      pointsSent,
      framesDropped: droppedFrames,
      framesPerSecond: lastFramesPerSecond,
      pointsPerFrame: lastPoints,
      speed: state?.twist?.linear.x ?? 0,
      turn: state?.twist?.angular.z ?? 0,
    });
  }
  return lines;
}
