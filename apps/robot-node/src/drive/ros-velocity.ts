/** Velocities as a ROS topic wants them: steady while driven, zero at once on silence, and then none, for others to drive. */
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
  /** Without a word for so long the velocity is zero, ms. */
  silenceMs: number;
  /** Robot’s clock, ms. */
  now: () => number;
  /** Time of day, ns since 1970, for stamps. */
  wallNs: () => bigint;
}

/** Zeros that are published after the last motion, ms: a base that lost one hears others, then Nav2 may drive. */
const TAIL_MS = 1000;
/** While nothing is heard, zeros come so often, ms. */
const REPEAT_MS = 40;
const FRAME = 'base_link';

/** Call `apply` at each word on the velocity, and at a steady rhythm; `tick` at least every few ms of the silence time. */
export class RosVelocity {
  /** How often silence made it zero. */
  silences = 0;
  readonly #publisher: Publisher;
  readonly #write: VelocityWriter;
  readonly #options: RosVelocityOptions;
  #twist: Twist = zeroTwist();
  readonly #watchdog: Watchdog;
  /** Zeros are published until then. */
  #tailEndMs = Number.NEGATIVE_INFINITY;
  #sentMs = Number.NEGATIVE_INFINITY;

  /** @throws {RosFault} where the graph refuses the topic */
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

  /** @param hold publish zeros for as long as this is said: an emergency stop is meant for other drivers, too */
  apply(twist: Twist, hold: boolean): void {
    const now = this.#options.now();
    this.#watchdog.feed(now);
    this.#twist = twist;
    if (hold || !isZeroTwist(twist)) this.#tailEndMs = now + TAIL_MS;
    this.#publish(now);
  }

  /** Looks whether there was silence. */
  tick(): void {
    const now = this.#options.now();
    // Before the first word there is nothing to repeat.
    if (!this.#wasFed || !this.#watchdog.expired(now)) return;
    if (!isZeroTwist(this.#twist)) {
      this.silences++;
      this.#twist = zeroTwist();
      this.#publish(now);
    }
    if (now - this.#sentMs >= REPEAT_MS) this.#publish(now);
  }

  /** Zero, and lets go of the topic. */
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
