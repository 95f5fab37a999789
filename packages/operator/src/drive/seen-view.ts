/** What is on the operator's screen: the newest capture that has been drawn. The robot judges its age by its own clock. */
import { type Command, pointsOfBytes, sequenceDelta32, stampUsOf } from '@farpoint/protocol';
import type { Batch } from '../cloud/batch.ts';

/**
 * The screen is as old as the newest capture since which this share of a whole cloud's points was drawn. A
 * page may draw a part of every cloud only (docs/safety.md).
 */
const SEEN_SHARE = 0.5;
/** So many frames of a sensor are remembered: a page that gets less than 1/16 of each cloud sees nothing. */
const FRAMES_KEPT = 8;

interface SensorFrame {
  number: number;
  captureUs: number;
  /** Share of its points that came, 0–1. */
  share: number;
}

/**
 * Keeps the capture time of the newest cloud or picture that is drawn. Of a poor link, or on a slow computer, some of every
 * cloud is missing, and what is drawn is made of several: then the older of those that make up half a cloud counts.
 * {@link RobotClient} creates and calls it.
 */
export class SeenView {
  /** By sensor: its latest frames, the newest first. */
  readonly #frames = new Map<number, SensorFrame[]>();
  /** Waits for the display frame that is being drawn. */
  #uploadedUs: number | null = null;
  #seenUs: number | null = null;

  /** Capture time of the newest thing on the screen: robot's monotonic clock, µs, modulo 2³²; `null` for nothing. */
  get stampUs(): number | null {
    return this.#seenUs;
  }

  /** A new session, or another robot: nothing has been seen of it. */
  reset(): void {
    this.#frames.clear();
    this.#uploadedUs = null;
    this.#seenUs = null;
  }

  /** A packet's points were uploaded for the display frame being prepared. @param packet index in the batch */
  onUploaded(batch: Batch, packet: number): void {
    const total = pointsOfBytes(batch.frameLength(packet));
    const came = batch.pointsCame(packet);
    this.onPoints(batch.sensor, batch.frameNumber(packet), batch.captureTimeUs(packet), came, total);
  }

  /**
   * Points were uploaded for the display frame being prepared.
   *
   * @param captureUs of their frame, robot's monotonic clock, µs, modulo 2³²
   * @param points of this packet, whether they are drawn or left out because the machine is slow
   * @param totalPoints of the frame
   */
  onPoints(
    sensor: number,
    frameNumber: number,
    captureUs: number,
    points: number,
    totalPoints: number,
  ): void {
    const frames = this.#framesOf(sensor);
    const frame = findFrame(frames, frameNumber, captureUs);
    if (frame === null || !(totalPoints > 0)) return;
    frame.share = Math.min(1, frame.share + points / totalPoints);
    const seenUs = seenOf(frames);
    if (seenUs !== null) this.#uploadedUs = newer(this.#uploadedUs, seenUs);
  }

  /** The display frame with the points of {@link onPoints} is finished. */
  onDrawn(): void {
    if (this.#uploadedUs === null) return;
    this.#seenUs = newer(this.#seenUs, this.#uploadedUs);
    this.#uploadedUs = null;
  }

  /** A camera's picture is on the screen. @param captureMs when it was captured, robot's monotonic clock, ms */
  onShown(captureMs: number): void {
    if (Number.isFinite(captureMs) && captureMs >= 0)
      this.#seenUs = newer(this.#seenUs, stampUsOf(captureMs));
  }

  /** The command with what its giver sees. */
  stamp(command: Command): Command {
    return this.#seenUs === null ? command : { ...command, seenUs: this.#seenUs };
  }

  #framesOf(sensor: number): SensorFrame[] {
    let frames = this.#frames.get(sensor);
    if (frames === undefined) {
      frames = [];
      this.#frames.set(sensor, frames);
    }
    return frames;
  }
}

/** The frame of this number, which is inserted in its place if it is not there; `null` if it is too old. */
function findFrame(frames: SensorFrame[], number: number, captureUs: number): SensorFrame | null {
  let at = 0;
  while (at < frames.length) {
    const frame = frames[at] as SensorFrame;
    const delta = sequenceDelta32(number, frame.number);
    if (delta === 0) return frame;
    if (delta > 0) break;
    at++;
  }
  if (at === FRAMES_KEPT) return null;
  // The oldest makes room, and is used again.
  const frame = frames.length < FRAMES_KEPT ? { number, captureUs, share: 0 } : (frames.pop() as SensorFrame);
  Object.assign(frame, { number, captureUs, share: 0 });
  frames.splice(at, 0, frame);
  return frame;
}

/** Capture time of the frame with which the newest ones add up to {@link SEEN_SHARE}; `null` if they do not. */
function seenOf(frames: readonly SensorFrame[]): number | null {
  let share = 0;
  for (const frame of frames) {
    share += frame.share;
    if (share >= SEEN_SHARE) return frame.captureUs;
  }
  return null;
}

function newer(before: number | null, stampUs: number): number {
  return before === null || sequenceDelta32(stampUs, before) > 0 ? stampUs : before;
}
