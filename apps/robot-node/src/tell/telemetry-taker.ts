import type { Alarm, DiagnosticReport } from '@farpoint/protocol';

/** Takes what the robot tells about itself besides its state, for a recording. Times are of the robot's clock, ms. */
export interface TelemetryTaker {
  /** @param timeMs when it was measured */
  sample(quantity: number, timeMs: number, value: number): void;
  /** @param timeMs when it changed, or when it is repeated */
  alarm(number: number, timeMs: number, alarm: Alarm): void;
  /** @param reports of all components of the topic @param timeMs when the newest came */
  diagnostics(topic: string, timeMs: number, reports: readonly DiagnosticReport[]): void;
}
