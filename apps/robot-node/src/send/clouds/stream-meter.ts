import type { StageTimings, StreamStatus } from '@farpoint/protocol';
import { BitRate, RateMeter } from '@farpoint/timing';
import { StageTimer } from '../../ground/stage-timer.ts';
import type { SharedFrame } from '../transport/shared-frame.ts';
import type { StreamSender } from '../transport/stream-sender.ts';

/**
 * What one operator's stream carries, for its telemetry. Frames and points are those of the first sensor, whereas bytes
 * count for everything that is streamed.
 */
export class StreamMeter {
  readonly #frames = new RateMeter();
  readonly #points = new RateMeter();
  readonly #bytes = new RateMeter();
  readonly #stages = new StageTimer();
  #framesSent = 0;
  #pointsSent = 0;
  #lastFrameNumber = 0;
  #lastValidPoints = 0;

  onQueued({ frame: { sensor, validPoints } }: SharedFrame): void {
    if (sensor === 0) this.#lastValidPoints = validPoints;
  }

  onSent({ frame: { sensor, frameNumber, points } }: SharedFrame, sendMs: number): void {
    this.#stages.add('sendMs', sendMs);
    if (sensor !== 0) return;
    this.#lastFrameNumber = frameNumber;
    this.#framesSent++;
    this.#pointsSent += points;
  }

  /** Call once per telemetry message: rates count from the previous call. */
  status(
    captureStages: StageTimings,
    sender: StreamSender | null,
    nowMs: number,
  ): { stages: StageTimings; stream: StreamStatus } {
    this.#frames.update(this.#framesSent, nowMs);
    this.#points.update(this.#pointsSent, nowMs);
    this.#bytes.update(sender?.counters.bytesSent ?? 0, nowMs);
    const framesPerSecond = this.#frames.perSecond;
    return {
      stages: { ...captureStages, sendMs: this.#stages.take().sendMs },
      stream: {
        frameNumber: this.#lastFrameNumber,
        framesPerSecond,
        pointsPerFrame: framesPerSecond > 0 ? this.#points.perSecond / framesPerSecond : 0,
        validPoints: this.#lastValidPoints,
        bitsPerSecond: BitRate.fromBytesPerSecond(this.#bytes.perSecond),
        targetBitsPerSecond: sender?.targetBitsPerSecond ?? 0,
        droppedFrames: droppedFrames(sender),
        ...(sender?.transportFeedback === false ? { feedback: 'reports' as const } : {}),
      },
    };
  }
}

/** Number of clouds that were dropped on the way, wholly or in part. */
export function droppedFrames(sender: StreamSender | null): number {
  const drops = sender?.droppedFrames;
  return drops === undefined ? 0 : drops.superseded + drops.overdue;
}
