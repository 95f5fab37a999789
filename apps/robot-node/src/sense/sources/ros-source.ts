/** Clouds, poses and readings from a live ROS graph, as the topic table allows. */

import {
  type BaseState,
  type CaptureRoom,
  type CaptureWishes,
  cameraOf,
  type FrameSource,
  type Mounted,
  type PictureTaker,
  type SourceDescription,
  type SourceFrame,
} from '@farpoint/cloud-source';
import type { Pose } from '@farpoint/protocol';
import {
  type CloudAxes,
  decoderOf,
  RosFault,
  type RosGraph,
  type TopicEntry,
  type TopicReading,
  type TopicTable,
  topicAs,
} from '@farpoint/ros';
import {
  type CaptureTime,
  capturedAtMs,
  LATE_MS,
  lateFault,
  type RosClock,
} from '../../ground/ros/capture-time.ts';
import { type Listener, listenBytes } from '../../ground/ros/ros-listener.ts';
import { REFUSED_AGE_MS, StampClock, stampRefusals } from '../../ground/ros/stamp-clock.ts';
import { readPicture } from '../pictures/picture-message.ts';
import { RosCloudFeed } from './ros-cloud-feed.ts';
import type { FeedShape, RosFeed } from './ros-feed.ts';
import { RosImageFeed } from './ros-image-feed.ts';
import { StateTopics } from './ros-state-topics.ts';
import { mountDispute } from './sensor-mount.ts';

/** Pictures for people to look at. A topic that nobody watches has no subscription. */
class RosPictureFeed {
  onFault: ((fault: RosFault) => void) | null = null;
  taker: PictureTaker | null = null;
  readonly #graph: RosGraph;
  readonly #entries: readonly TopicEntry[];
  readonly #listeners = new Map<number, Listener>();
  readonly #captureTime: CaptureTime;

  /** @param entries the topics; the index among them is the camera's number */
  constructor(graph: RosGraph, entries: readonly TopicEntry[], captureTime: CaptureTime) {
    this.#graph = graph;
    this.#entries = entries;
    this.#captureTime = captureTime;
  }

  /**
   * Subscribes to the watched topics and no others. @param perSecond pictures per second for each camera; 0: nobody
   * watches
   */
  watch(perSecond: readonly number[]): void {
    for (const [camera, entry] of this.#entries.entries()) {
      const listener = this.#listeners.get(camera);
      if ((perSecond[camera] ?? 0) > 0) {
        if (listener === undefined) this.#listeners.set(camera, this.#listen(camera, entry));
      } else if (listener !== undefined) {
        listener.close();
        this.#listeners.delete(camera);
      }
    }
  }

  close(): void {
    this.watch([]);
  }

  #listen(camera: number, entry: TopicEntry): Listener {
    const decode = decoderOf(this.#graph.version, entry.type, null);
    const onFault = (fault: RosFault) => this.onFault?.(fault);
    // The receiver limits the rate.
    return listenBytes(this.#graph, entry, { queue: 1, limited: false, onFault }, (bytes, receivedMs) => {
      const { taker } = this;
      if (taker === null || !taker.wants(camera, receivedMs)) return;
      const { stampNs, facts, data } = readPicture(entry.type, decode(bytes));
      taker.offer({ camera, capturedAtMs: this.#captureTime(stampNs, receivedMs), facts, data });
    });
  }
}

/** How often the same fault is told, ms; and how many are remembered. Chosen: a log that people can read. */
const AGAIN_MS = 10_000;
const MOST_FAULTS = 64;

/** Lets the same fault through now and then: a topic may have it in every message. */
class FaultLimit {
  readonly #toldMs = new Map<string, number>();

  /** Whether to tell it. */
  admits(fault: string, nowMs: number): boolean {
    const before = this.#toldMs.get(fault);
    if (before !== undefined && nowMs - before < AGAIN_MS) return false;
    // The order of a map is that in which its keys came.
    this.#toldMs.delete(fault);
    this.#toldMs.set(fault, nowMs);
    const oldest = this.#toldMs.keys().next();
    if (this.#toldMs.size > MOST_FAULTS && !oldest.done) this.#toldMs.delete(oldest.value);
    return true;
  }
}

export interface RosSourceOptions {
  topics: TopicTable;
  /** Axes of the clouds' frame. `auto`: optical if the frame's name says so (REP-103), otherwise body. */
  axes: CloudAxes | 'auto';
  /** Frame of the robot's base; by default as odometry and tf name it. */
  baseFrame?: string | null;
  /** How long to wait for the first frame, ms. */
  waitMs: number;
}

export class RosSource implements FrameSource {
  readonly description: SourceDescription;
  onReady: (() => void) | null = null;
  onFault: ((error: Error) => void) | null = null;
  onReading: ((reading: TopicReading) => void) | null = null;
  readonly #graph: RosGraph;
  readonly #feed: RosFeed;
  readonly #axes: CloudAxes;
  readonly #state: StateTopics;
  readonly #stamps: StampClock;
  readonly #mount: Pose | null;
  readonly #topic: string;
  readonly #faults = new FaultLimit();
  readonly #pictures: RosPictureFeed;

  private constructor(
    graph: RosGraph,
    feed: RosFeed,
    shape: FeedShape,
    state: StateTopics,
    { topics, mount = null }: RosSourceOptions & Mounted,
    stamps: StampClock,
    clock: RosClock,
  ) {
    this.#graph = graph;
    this.#feed = feed;
    this.#axes = shape.axes;
    this.#state = state;
    this.#stamps = stamps;
    this.#mount = mount;
    this.#topic = feed.listeners.at(-1)?.entry.topic ?? '';
    const { width, height, capacity, camera, axes } = shape;
    const pictures = topics.filter(({ as }) => as === 'picture');
    const names = feed.listeners.map(({ entry }) => entry.topic).join(', ');
    this.description = {
      kind: `ros${graph.version} (${names}, ${axes} frame)`,
      width,
      height,
      capacity,
      camera,
      depthMeasure: axes === 'body' ? 'range' : 'z',
      cameras: pictures.map(cameraOf),
    };
    this.#pictures = new RosPictureFeed(graph, pictures, (stampNs, receivedMs) =>
      Math.min(capturedAtMs(clock, stampNs, receivedMs), clock.now()),
    );
    this.#pictures.onFault = (fault) => this.onFault?.(fault);
    feed.onFrame = () => this.onReady?.();
    feed.onFault = (fault) => this.onFault?.(fault);
    state.onFault = (fault) => this.#tell(fault, clock.now());
    state.onReading = (reading) => this.onReading?.(reading);
    graph.onFault = (fault) => this.onFault?.(fault);
  }

  /**
   * Subscribes to the table's topics and waits for the first frame. The source owns the graph from then on.
   *
   * @throws {RosFault} saying what did not arrive and the possible causes
   */
  static async open(
    graph: RosGraph,
    options: RosSourceOptions & Mounted,
    clock: RosClock,
  ): Promise<RosSource> {
    const { topics, axes, waitMs, baseFrame = null } = options;
    let last: RosFault | null = null;
    const onFault = (fault: RosFault) => {
      last = fault;
    };
    graph.onFault = onFault;
    const stamps = new StampClock(clock);
    const state = new StateTopics(graph, topics, clock, stamps, baseFrame);
    let feed: RosFeed | null = null;
    try {
      feed = openFeed(graph, topics, axes);
      feed.onFault = onFault;
      await firstFrame(feed, waitMs);
      if (feed.shape === null) throw whyNothing(graph, feed, waitMs, last);
      return new RosSource(graph, feed, feed.shape, state, options, stamps, clock);
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
    return this.#state.state;
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
    const judged = this.#stamps.inOrder(this.#topic, stampNs, receivedMs);
    const isKnown = typeof judged === 'number';
    const capturedMs = Math.min(isKnown ? judged : receivedMs - REFUSED_AGE_MS, nowMs);
    const stamp = this.#placed(frameId, capturedMs, isKnown, nowMs);
    if (!isKnown)
      this.#tell(new RosFault('bad-message', stampRefusals[judged], { topic: this.#topic }), nowMs);
    else if (nowMs - capturedMs > LATE_MS) this.#tell(lateFault(this.#topic), nowMs);
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

  /** @param isKnown whether it is known when it was captured */
  #placed(frameId: string, capturedAtMs: number, isKnown: boolean, nowMs: number) {
    const mount = this.#mount;
    const atMs = isKnown ? capturedAtMs : nowMs;
    const { cameraPose, base, mount: told } = this.#state.world.place(frameId, atMs, this.#axes, mount);
    if (!this.#state.hasPoses) return { cameraPose, capturedAtMs };
    const dispute = mount === null || told === null ? null : mountDispute(mount, told);
    if (dispute !== null)
      this.#tell(
        new RosFault('bad-cloud', `guard.mount and tf disagree about where ${frameId} sits: by ${dispute}`, {
          topic: this.#topic,
          remedy: 'correct the one that is wrong, or leave tf out',
        }),
        nowMs,
      );
    const known = isKnown && base !== null ? base : 'unknown';
    return { cameraPose, capturedAtMs, base: dispute === null ? known : 'disputed' } as const;
  }

  /** What comes with every message is told now and then. */
  #tell(fault: RosFault, nowMs: number): void {
    if (this.#faults.admits(fault.message, nowMs)) this.onFault?.(fault);
  }
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
