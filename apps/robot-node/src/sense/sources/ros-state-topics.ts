/** The topics of a ROS graph that report the robot's pose and state, and what else they say for people. */

import type { BaseState } from '@farpoint/cloud-source';
import {
  fixStampNs,
  ModelTopic,
  NavigationTopic,
  RateLimit,
  RosFault,
  type RosGraph,
  type StampTimes,
  type TopicEntry,
  type TopicReading,
  type TopicTable,
  WorldState,
} from '@farpoint/ros';
import { LATE_MS, lateFault, type RosClock } from '../../ground/ros/capture-time.ts';
import { ReadingTopic } from '../../ground/ros/reading-topic.ts';
import { type Listener, listen } from '../../ground/ros/ros-listener.ts';
import { type StampClock, stampRefusals } from '../../ground/ros/stamp-clock.ts';

/** Number of state messages that may wait in the graph. */
const STATE_QUEUE = 100;
const STATE_ROLES = ['pose', 'tf', 'battery'];
const SPOKEN = [ReadingTopic, NavigationTopic, ModelTopic];
/**
 * How often a path or a map whose frame was unknown is tried again, times a second. Chosen: transforms come
 * within half of a second, and each try costs a look-up only.
 */
const RETRIES = 2;

export class StateTopics {
  readonly world: WorldState;
  onFault: ((fault: RosFault) => void) | null = null;
  onReading: ((reading: TopicReading) => void) | null = null;
  readonly #stamps: StampClock;
  readonly #clock: RosClock;
  readonly #listeners: Listener[];
  readonly #navigation: NavigationTopic[] = [];
  readonly #retries = new RateLimit(RETRIES);
  /** Whether anything is to say where the robot is: clouds are placed by it. */
  readonly hasPoses: boolean;
  /** When the message came that is being read. */
  #receivedMs = 0;
  /** What {@link #tell} was given before {@link start}. */
  #early: Map<string, TopicReading> | null = new Map();

  /** @param base the frame of the robot's base; `null`: as odometry and tf name it */
  constructor(
    graph: RosGraph,
    topics: TopicTable,
    clock: RosClock,
    stamps: StampClock,
    base: string | null = null,
  ) {
    this.#clock = clock;
    this.#stamps = stamps;
    this.world = new WorldState(this.#times, base);
    this.hasPoses = topics.some(({ as }) => as === 'pose' || as === 'tf');
    this.#listeners = topics
      .filter((entry) => isHeard(entry))
      .map((entry) => this.#listen(graph, entry, base));
  }

  /** The callbacks are set. */
  start(): void {
    const early = this.#early ?? new Map<string, TopicReading>();
    this.#early = null;
    for (const reading of early.values()) this.onReading?.(reading);
  }

  /** What they say about the base. Without any of them, the robot counts as standing where it is. */
  get state(): BaseState {
    const { battery } = this.world;
    const { pose, twist, timeMs } = this.world.base;
    return { pose, twist, battery, contact: false, measuredMs: timeMs };
  }

  close(): void {
    for (const listener of this.#listeners) listener.close();
  }

  readonly #times: StampTimes = {
    of: (source, stampNs, mayBeAhead) => {
      const isTransform = source === '' || source.startsWith('tf ');
      return isTransform
        ? this.#stamps.ofTransform(source, stampNs, this.#receivedMs, mayBeAhead)
        : this.#inOrder(source, stampNs);
    },
  };

  /** @returns why the stamp is refused */
  #inOrder(topic: string, stampNs: bigint): number | string {
    const judged = this.#stamps.inOrder(topic, stampNs, this.#receivedMs);
    if (typeof judged === 'string') return stampRefusals[judged];
    if (this.#receivedMs - judged > LATE_MS) this.onFault?.(lateFault(topic));
    return judged;
  }

  #listen(graph: RosGraph, entry: TopicEntry, base: string | null): Listener {
    const { topic: name, type, as } = entry;
    const clock = this.#clock;
    const onFault = (fault: RosFault) => this.onFault?.(fault);
    const reading = ReadingTopic.is(entry) ? new ReadingTopic(entry) : null;
    const navigation = NavigationTopic.is(entry) ? new NavigationTopic(entry) : null;
    if (navigation !== null) this.#navigation.push(navigation);
    const model = ModelTopic.is(entry) ? new ModelTopic(entry, base) : null;
    const limited = reading?.readsAll !== true && as !== 'joints';
    return listen(graph, entry, { queue: STATE_QUEUE, limited, onFault }, (message, receivedMs) => {
      this.#receivedMs = receivedMs;
      if (STATE_ROLES.includes(as)) this.#refused(name, this.world.take({ name, type }, message));
      const told = reading?.take(message, clock.now()) ?? null;
      if (told !== null) this.onReading?.(as === 'fix' ? this.#timed(name, told, message) : told);
      const shown = model?.take(message, clock.now()) ?? null;
      if (shown !== null) this.#tell(shown);
      if (navigation !== null) this.#tell(navigation.take(message, this.#framePose));
      else if (as === 'tf' || as === 'pose') this.#retryNavigation(clock.now());
    });
  }

  /** The fence rests on when a position was measured. */
  #timed(topic: string, told: TopicReading, message: unknown): TopicReading {
    const judged = this.#inOrder(topic, fixStampNs(message));
    if (typeof judged === 'number') return { ...told, measuredMs: judged };
    this.#refused(topic, judged);
    return { ...told, measuredMs: null };
  }

  #refused(topic: string, why: string | null): void {
    if (why !== null) this.onFault?.(new RosFault('bad-message', why, { topic }));
  }

  readonly #framePose = (frameId: string, stampNs: bigint) => this.world.framePose(frameId, stampNs);

  #retryNavigation(nowMs: number): void {
    if (!this.#navigation.some(({ waits }) => waits) || !this.#retries.admits(nowMs)) return;
    for (const topic of this.#navigation) {
      const told = topic.retry(this.#framePose);
      if (told !== null) this.#tell(told);
    }
  }

  /** What may come once only: it is kept until {@link start}. */
  #tell(reading: TopicReading): void {
    if (this.#early === null) this.onReading?.(reading);
    else this.#early.set(reading.topic, reading);
  }
}

function isHeard(entry: TopicEntry): boolean {
  return STATE_ROLES.includes(entry.as) || SPOKEN.some((kind) => kind.is(entry));
}
