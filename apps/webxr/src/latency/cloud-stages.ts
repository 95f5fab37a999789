/** Where the time of the clouds goes: the page's own stages, with the robot's measurements of its part. Pure. */
import type { FrameStages, Telemetry } from '@farpoint/operator';

/** Means, ms. Those that are known add up to the latency; those that are `null` are part of `wayMs` or `drawMs`. */
export interface CloudStages {
  /** Reading the cloud from the camera. */
  readonly captureMs: number | null;
  readonly encodeMs: number | null;
  /** What is left until the first packet arrived: waiting at the robot, and the network. */
  readonly wayMs: number;
  /** From the first packet to the last. */
  readonly furtherMs: number;
  readonly decodeMs: number | null;
  /** Waiting for the display, and drawing. */
  readonly drawMs: number;
}

/**
 * @param robot what the robot measures; `null` if it does not say, or says it of several sensors together
 * @param decodeUs mean time that a packet takes to be decoded, µs
 */
export function cloudStages(
  { firstPacketMs, furtherPacketsMs, drawMs }: FrameStages,
  robot: Telemetry['stages'] | null,
  decodeUs: number,
): CloudStages {
  const captureMs = robot?.captureMs ?? 0;
  const encodeMs = robot === null ? 0 : robot.sampleMs + robot.packMs;
  // A stage cannot take longer than what it is part of: these are not of the same frames then.
  const splits = robot !== null && captureMs + encodeMs <= firstPacketMs;
  const decodeMs = decodeUs / 1000;
  const decodes = decodeMs > 0 && decodeMs <= drawMs;
  return {
    captureMs: splits ? captureMs : null,
    encodeMs: splits ? encodeMs : null,
    wayMs: splits ? firstPacketMs - captureMs - encodeMs : firstPacketMs,
    furtherMs: furtherPacketsMs,
    decodeMs: decodes ? decodeMs : null,
    drawMs: decodes ? drawMs - decodeMs : drawMs,
  };
}
