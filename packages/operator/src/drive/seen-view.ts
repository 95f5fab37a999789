/** What is on the operator's screen: the newest capture that has been drawn. The robot judges its age by its own clock. */
import { type Command, type GoalHold, pointsOfBytes, sequenceDelta32, stampUsOf } from '@farpoint/protocol';
import type { Batch } from '../cloud/batch.ts';

/** A cloud counts as seen when this share of its points is drawn: of a poor link, some are always missing. */
const SEEN_SHARE = 0.5;

interface SensorFrame {
  number: number;
  points: number;
}

/** Keeps the capture time of the newest cloud or picture that is drawn. {@link RobotClient} creates and calls it. */
export class SeenView {
  /** By sensor: the frame that arrives. */
  readonly #frames = new Map<number, SensorFrame>();
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
    let frame = this.#frames.get(sensor);
    if (frame === undefined) {
      frame = { number: frameNumber, points: 0 };
      this.#frames.set(sensor, frame);
    } else if (frame.number !== frameNumber) {
      if (sequenceDelta32(frameNumber, frame.number) < 0) return;
      frame.number = frameNumber;
      frame.points = 0;
    }
    frame.points += points;
    if (frame.points >= totalPoints * SEEN_SHARE) this.#uploadedUs = newer(this.#uploadedUs, captureUs);
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

  /** The command, or the hold of a goal, with what its giver sees. */
  stamp<T extends Command | GoalHold>(command: T): T {
    return this.#seenUs === null ? command : { ...command, seenUs: this.#seenUs };
  }
}

function newer(before: number | null, stampUs: number): number {
  return before === null || sequenceDelta32(stampUs, before) > 0 ? stampUs : before;
}
