/** What the operator saw of each sensor in a run. */
import { type Distribution, rounded } from './stats.ts';

/** As the page counts, since the session began. */
export interface SensorSums {
  frames: number;
  points: number;
  packets: number;
  frameLatencyMs: Distribution | null;
}

export interface SensorRow {
  name: string;
  pointsPerFrame: number;
  framesPerSecond: number;
  /** Capture to the display frame with the frame's last points. */
  frameLatencyMs: Distribution;
  /** Of the packets that were drawn of all sensors. */
  share: number;
}

/**
 * @param named the robot's sensors, in their order
 * @param after sums at the end of the run, and before it
 */
export function sensorRows(
  named: readonly { name: string }[],
  after: readonly SensorSums[],
  before: readonly SensorSums[],
  seconds: number,
): SensorRow[] {
  const grown = after.map((sums, sensor) => {
    // A session that began in between counts from 0.
    const since =
      before[sensor]?.frames !== undefined && before[sensor].frames <= sums.frames ? before[sensor] : null;
    return {
      frames: sums.frames - (since?.frames ?? 0),
      points: sums.points - (since?.points ?? 0),
      packets: sums.packets - (since?.packets ?? 0),
      latency: sums.frameLatencyMs,
    };
  });
  const allPackets = grown.reduce((sum, { packets }) => sum + packets, 0);
  return grown.map(({ frames, points, packets, latency }, sensor) => ({
    name: named[sensor]?.name ?? 'Camera',
    pointsPerFrame: Math.round(points / Math.max(frames, 1)),
    framesPerSecond: Number((frames / seconds).toFixed(1)),
    frameLatencyMs: rounded(latency ?? NOTHING, 1),
    share: Number((packets / Math.max(allPackets, 1)).toFixed(3)),
  }));
}

const NOTHING = { p50: Number.NaN, p95: Number.NaN, p99: Number.NaN, max: Number.NaN };
