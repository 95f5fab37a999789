/** Clouds, poses and readings from a live ROS graph, as the topic table allows. */

import {
  type CloudAxes,
  ModelTopic,
  NavigationTopic,
  RateLimit,
  RosFault,
  type RosGraph,
  type TopicEntry,
  type TopicReading,
  type TopicTable,
  topicAs,
  WorldState,
} from '@farpoint/ros';
import type { BaseState } from '../base/base.ts';
import type { PictureTaker } from '../pictures/source-picture.ts';
import { capturedAtMs, type RosClock } from '../ros/capture-time.ts';
import {
  type CaptureRoom,
  type CaptureWishes,
  cameraOf,
  type FrameSource,
  type SourceDescription,
  type SourceFrame,
} from './frame-source.ts';
import { ReadingTopic } from './reading-topic.ts';
import { RosCloudFeed } from './ros-cloud-feed.ts';
import type { FeedShape, RosFeed } from './ros-feed.ts';
import { RosImageFeed } from './ros-image-feed.ts';
import { type Listener, listen } from './ros-listener.ts';
import { RosPictureFeed } from './ros-picture-feed.ts';

export interface RosSourceOptions {
  topics: TopicTable;
  /** Axes of the clouds' frame. `auto`: optical if the frame's name says so (REP-103), otherwise body. */
  axes: CloudAxes | 'auto';
  /** How long to wait for the first frame, ms. */
  waitMs: number;
}

/** Number of state messages that may wait in the graph. */
const STATE_QUEUE = 100;
const STATE_ROLES = ['pose', 'tf', 'battery'];
const SPOKEN = [ReadingTopic, NavigationTopic, ModelTopic];
/** How often a path or a map whose frame was unknown is tried again, times a second. */
const RETRIES = 2;

export class RosSource implements FrameSource {
  readonly description: SourceDescription;
  onReady: (() => void) | null = null;
  onFault: ((error: Error) => void) | null = null;
  onReading: ((reading: TopicReading) => void) | null = null;
  readonly #graph: RosGraph;
  readonly #feed: RosFeed;
  readonly #axes: CloudAxes;
  readonly #world: WorldState;
  readonly #state: StateTopics;
  readonly #clock: RosClock;
  readonly #pictures: RosPictureFeed;

  private constructor(
    graph: RosGraph,
    feed: RosFeed,
    shape: FeedShape,
    state: StateTopics,
    topics: TopicTable,
    clock: RosClock,
  ) {
    this.#graph = graph;
    this.#feed = feed;
    this.#axes = shape.axes;
    this.#world = state.world;
    this.#state = state;
    this.#clock = clock;
    const { width, height, capacity, camera, axes } = shape;
    const pictures = topics.filter(({ as }) => as === 'picture');
    const names = feed.listeners.map(({ entry }) => entry.topic).join(', ');
    this.description = {
      kind: `ros${graph.version} (${names}, ${axes} frame)`,
      ...{ width, height, capacity, camera },
      depthMeasure: axes === 'body' ? 'range' : 'z',
      cameras: pictures.map(cameraOf),
    };
    this.#pictures = new RosPictureFeed(graph, pictures, (stampNs, receivedMs) =>
      this.#capturedAtMs(stampNs, receivedMs, clock.now()),
    );
    this.#pictures.onFault = (fault) => this.onFault?.(fault);
    feed.onFrame = () => this.onReady?.();
    feed.onFault = (fault) => this.onFault?.(fault);
    state.onFault = (fault) => this.onFault?.(fault);
    state.onReading = (reading) => this.onReading?.(reading);
    graph.onFault = (fault) => this.onFault?.(fault);
  }

  /**
   * Subscribes to the table's topics and waits for the first frame. The source owns the graph from then on.
   *
   * @throws {RosFault} saying what did not arrive and the possible causes
   */
  static async open(graph: RosGraph, options: RosSourceOptions, clock: RosClock): Promise<RosSource> {
    const { topics, axes, waitMs } = options;
    let last: RosFault | null = null;
    const onFault = (fault: RosFault) => {
      last = fault;
    };
    graph.onFault = onFault;
    const state = new StateTopics(graph, topics, clock);
    let feed: RosFeed | null = null;
    try {
      feed = openFeed(graph, topics, axes);
      feed.onFault = onFault;
      await firstFrame(feed, waitMs);
      if (feed.shape === null) throw whyNothing(graph, feed, waitMs, last);
      return new RosSource(graph, feed, feed.shape, state, topics, clock);
    } catch (error) {
      feed?.close();
      state.close();
      await graph.close();
      throw error;
    }
  }

  start(): void {
    this.#state.start();
  }

  get state(): BaseState {
    const { basePose: pose, twist, battery } = this.#world;
    const { measuredMs } = this.#state;
    return { pose, twist, battery, contact: false, ...(measuredMs === null ? {} : { measuredMs }) };
  }

  get rings(): readonly number[] | null {
    return this.#feed.rings ?? null;
  }

  capture(nowMs: number, _wishes: CaptureWishes, room: CaptureRoom): SourceFrame | null {
    let fed: ReturnType<RosFeed['take']>;
    try {
      fed = this.#feed.take(room);
    } catch (error) {
      this.onFault?.(error as Error);
      return null;
    }
    if (fed === null) return null;
    const { count, frameId, stampNs, receivedMs } = fed;
    const stamp = {
      cameraPose: this.#world.opticalPose(frameId, stampNs, this.#axes),
      capturedAtMs: this.#capturedAtMs(stampNs, receivedMs, nowMs),
    };
    return this.description.camera === null
      ? { form: 'points', points: room.points, count, ...stamp }
      : { form: 'images', depth: room.depth, colour: room.colour, ...stamp };
  }

  usePictures(taker: PictureTaker): void {
    this.#pictures.taker = taker;
  }

  watchPictures(perSecond: readonly number[]): void {
    this.#pictures.watch(perSecond);
  }

  skip(): void {
    this.#feed.skip();
  }

  close(): void {
    this.#feed.close();
    this.#pictures.close();
    this.#state.close();
    void this.#graph.close();
  }

  #capturedAtMs(stampNs: bigint, receivedMs: number, nowMs: number): number {
    return Math.min(capturedAtMs(this.#clock, stampNs, receivedMs), nowMs);
  }
}

/** The topics that report the robot's pose and state. */
class StateTopics {
  readonly world = new WorldState();
  /** When the robot's pose last came, ms on the robot's clock. */
  measuredMs: number | null = null;
  onFault: ((fault: RosFault) => void) | null = null;
  onReading: ((reading: TopicReading) => void) | null = null;
  readonly #listeners: Listener[];
  readonly #navigation: NavigationTopic[] = [];
  readonly #retries = new RateLimit(RETRIES);
  /** What {@link #tell} was given before {@link start}. */
  #early: Map<string, TopicReading> | null = new Map();

  constructor(graph: RosGraph, topics: TopicTable, clock: RosClock) {
    const poseRole = topicAs(topics, 'pose') === undefined ? 'tf' : 'pose';
    this.#listeners = topics
      .filter((entry) => isHeard(entry))
      .map((entry) => this.#listen(graph, entry, clock, poseRole));
  }

  /** The callbacks are set. */
  start(): void {
    const early = this.#early ?? new Map<string, TopicReading>();
    this.#early = null;
    for (const reading of early.values()) this.onReading?.(reading);
  }

  close(): void {
    for (const listener of this.#listeners) listener.close();
  }

  /** @param poseRole of the topics that say where the robot is */
  #listen(graph: RosGraph, entry: TopicEntry, clock: RosClock, poseRole: 'pose' | 'tf'): Listener {
    const { topic: name, type, as } = entry;
    const onFault = (fault: RosFault) => this.onFault?.(fault);
    const reading = ReadingTopic.is(entry) ? new ReadingTopic(entry) : null;
    const navigation = NavigationTopic.is(entry) ? new NavigationTopic(entry) : null;
    if (navigation !== null) this.#navigation.push(navigation);
    const model = ModelTopic.is(entry) ? new ModelTopic(entry) : null;
    const limited = reading?.readsAll !== true && as !== 'joints';
    return listen(graph, entry, { queue: STATE_QUEUE, limited, onFault }, (message) => {
      if (STATE_ROLES.includes(as)) this.world.take({ name, type }, message);
      if (as === poseRole) this.measuredMs = clock.now();
      const told = reading?.take(message, clock.now()) ?? null;
      if (told !== null) this.onReading?.(told);
      const shown = model?.take(message, clock.now()) ?? null;
      if (shown !== null) this.#tell(shown);
      if (navigation !== null) this.#tell(navigation.take(message, this.#framePose));
      else if (as === 'tf' || as === 'pose') this.#retryNavigation(clock.now());
    });
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

/** @throws {RosFault} if the table has no clouds */
function openFeed(graph: RosGraph, topics: TopicTable, axes: CloudAxes | 'auto'): RosFeed {
  const [cloud, depth, colour, cameraInfo] = [
    topicAs(topics, 'cloud'),
    topicAs(topics, 'depth'),
    topicAs(topics, 'colour'),
    topicAs(topics, 'cameraInfo'),
  ];
  if (cloud !== undefined) return new RosCloudFeed(graph, { cloud, cameraInfo, axes });
  if (depth !== undefined && cameraInfo !== undefined)
    return new RosImageFeed(graph, { depth, colour, cameraInfo });
  throw new RosFault('unavailable', 'no topic is named for clouds', {
    remedy: 'name one as cloud, or one as depth',
  });
}

async function firstFrame(feed: RosFeed, waitMs: number): Promise<void> {
  if (feed.shape !== null) return;
  await new Promise<void>((resolve) => {
    const timer = setTimeout(resolve, waitMs);
    feed.onFrame = () => {
      clearTimeout(timer);
      resolve();
    };
  });
}

/** What did not arrive, and why, as far as known. */
function whyNothing(graph: RosGraph, feed: RosFeed, waitMs: number, last: RosFault | null): RosFault {
  if (last !== null) return last;
  const silent = feed.listeners.find(({ received }) => received === 0) ?? feed.listeners[0];
  const { topic, type } = silent?.entry ?? { topic: '', type: '' };
  const seen = graph.topics().find((each) => each.topic === topic);
  const others = graph.topics().filter((each) => each.type === type && each.publishers > 0);
  const named = others.map((each) => each.topic).join(', ');
  const within = `within ${waitMs / 1000} s`;
  if (seen !== undefined && seen.publishers > 0 && seen.type !== type) {
    return new RosFault('wrong-type', `it has ${seen.type}, not ${type}`, { topic });
  }
  if ((seen?.publishers ?? silent?.publishers ?? 0) > 0) {
    return new RosFault('unavailable', `no message ${within}, although it is published`, { topic });
  }
  return new RosFault('unavailable', `nobody publishes it (${within})`, {
    topic,
    remedy: named === '' ? `nobody publishes ${type} at all` : `with ${type} there is ${named}`,
  });
}
