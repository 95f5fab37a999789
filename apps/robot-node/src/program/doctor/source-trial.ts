/** Opens the source as the robot would, in its own thread, and observes its frames. */

import type { SourceDescription } from '@farpoint/cloud-source';
import { Capture } from '../../sense/capture/capture.ts';
import type { CaptureOptions } from '../../sense/capture/capture-messages.ts';
import { CODED_FORMATS } from '../../sense/encode/plan.ts';

export interface SourceTrial {
  description: SourceDescription;
  frames: number;
  /** Time between the first and the last frame, s. */
  seconds: number;
  /** Points of the last frame that could be sent. */
  validPoints: number;
  /** Mean time to capture and encode a frame, ms. */
  workMs: number;
  faults: readonly string[];
}

/** More than any camera needs: the trial tests the source, not a link. */
const BITS_PER_SECOND = 200e6;
/**
 * What the transport adds to each packet, bytes. Chosen near the 76 of video-frame.ts: the trial tests the
 * source, not a link.
 */
const PACKET_OVERHEAD_BYTES = 60;

/**
 * @param watchMs how long to observe the source once it is open
 * @throws {CaptureError} if it cannot be opened, with the reason
 */
export async function trySource(options: CaptureOptions, watchMs: number): Promise<SourceTrial> {
  const capture = await Capture.start(options);
  const faults: string[] = [];
  const trial = { frames: 0, validPoints: 0, workMs: 0 };
  let firstMs = 0;
  let lastMs = 0;
  capture.onFault = (detail) => faults.push(detail);
  const broken = new Promise<never>((_, reject) => {
    capture.onFailure = reject;
  });
  capture.onFrame = (frame) => {
    if (trial.frames === 0) firstMs = frame.readyMs;
    lastMs = frame.readyMs;
    trial.frames++;
    trial.validPoints = frame.validPoints;
    trial.workMs += (frame.captureMs + frame.sampleMs + frame.packMs - trial.workMs) / trial.frames;
    capture.recycle(frame.buffer);
  };
  capture.setBudget({
    targetBitsPerSecond: BITS_PER_SECOND,
    overheadBytes: PACKET_OVERHEAD_BYTES,
    streaming: true,
    probe: null,
    coded: CODED_FORMATS.map((format) => ({
      format,
      targetBitsPerSecond: BITS_PER_SECOND,
      plainBitsPerSecond: null,
    })),
  });
  let timer: NodeJS.Timeout | undefined;
  const watched = new Promise<void>((resolve) => {
    timer = setTimeout(resolve, watchMs);
  });
  try {
    await Promise.race([watched, broken]);
  } finally {
    clearTimeout(timer);
    // Do not wait for a source that hangs while closing: the program ends anyway.
    void capture.close();
  }
  return { description: capture.description, ...trial, seconds: (lastMs - firstMs) / 1000, faults };
}
