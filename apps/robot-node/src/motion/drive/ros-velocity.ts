/**
 * Publishes velocities as a ROS topic expects them: at a steady rate while driven, zero immediately on silence, and
 * then nothing, so that others can drive.
 */
import { isZeroTwist, type Twist, zeroTwist } from '@farpoint/protocol';
import {
  type Publisher,
  qosOf,
  type RosGraph,
  type TopicEntry,
  type VelocityWriter,
  velocityWriter,
} from '@farpoint/ros';
import { Watchdog } from '@farpoint/safety';

export interface RosVelocityOptions {
  entry: TopicEntry;
  /** After this long without a velocity, zero is published, ms. */
  silenceMs: number;
  /** Robot’s clock, ms. */
  now: () => number;
  /** Time of day, ns since 1970, for stamps. */
  wallNs: () => bigint;
}

/**
 * How long zeros are published after the last motion, ms. A base that loses one receives others; afterwards
 * Nav2 may drive. Chosen: twice the 0.5 s after which diff_drive_controller stops by itself (docs/ros.md).
 */
export const TAIL_MS = 1000;
/** Interval between zeros during silence, ms. As often as velocities are refreshed (drive-station.ts). */
export const REPEAT_MS = 40;
const FRAME = 'base_link';

/** Call `apply` at each velocity and at a steady rate, and `checkSilence` every few ms. */
export class RosVelocity {
  /** How often silence made the velocity zero. */
  silences = 0;
  readonly #publisher: Publisher;
  readonly #write: VelocityWriter;
  readonly #options: RosVelocityOptions;
  #twist: Twist = zeroTwist();
  readonly #watchdog: Watchdog;
  /** Zeros are published until this time. */
  #tailEndMs = Number.NEGATIVE_INFINITY;
  #sentMs = Number.NEGATIVE_INFINITY;

  /** @throws {RosFault} if the graph refuses the topic */
  constructor(graph: RosGraph, options: RosVelocityOptions) {
    this.#options = options;
    this.#watchdog = new Watchdog(options.silenceMs);
    const { topic, type } = options.entry;
    this.#write = velocityWriter(graph.version, type);
    this.#publisher = graph.advertise({ topic, type, qos: qosOf(options.entry) });
  }

  get subscribers(): number {
    return this.#publisher.subscribers;
  }

  /** @param hold publish zeros for as long as this is true, because an emergency stop also applies to other drivers */
  apply(twist: Twist, hold: boolean): void {
    const now = this.#options.now();
    this.#watchdog.feed(now);
    this.#twist = twist;
    if (hold || !isZeroTwist(twist)) this.#tailEndMs = now + TAIL_MS;
    this.#publish(now);
  }

  /** Stops the robot after a silence, and repeats the stop. */
  checkSilence(): void {
    const now = this.#options.now();
    // Before the first velocity there is nothing to repeat.
    if (!this.#wasFed || !this.#watchdog.expired(now)) return;
    if (!isZeroTwist(this.#twist)) {
      this.silences++;
      this.#twist = zeroTwist();
      this.#publish(now);
    }
    if (now - this.#sentMs >= REPEAT_MS) this.#publish(now);
  }

  /** Publishes zero and releases the topic. */
  close(): void {
    if (this.#wasFed && this.#options.now() < this.#tailEndMs) this.#send(zeroTwist());
    this.#publisher.close();
  }

  get #wasFed(): boolean {
    return this.#watchdog.deadlineMs !== null;
  }

  #publish(now: number): void {
    if (now < this.#tailEndMs) this.#send(this.#twist);
  }

  #send(twist: Twist): void {
    this.#sentMs = this.#options.now();
    this.#publisher.publish(this.#write(twist, this.#options.wallNs(), FRAME));
  }
}
