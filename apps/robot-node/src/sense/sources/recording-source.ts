import { setTimeout as delay } from 'node:timers/promises';
import {
  type BaseState,
  type CameraDescription,
  type CaptureRoom,
  type CaptureWishes,
  cameraOf,
  type FrameSource,
  type PictureTaker,
  type PlayedMessage,
  type PlayedPicture,
  type SourceDescription,
  type SourceFrame,
} from '@farpoint/cloud-source';
import {
  CloudPlayer,
  type PlayClock,
  type PlayOptions,
  type RecordedMessage,
  type RecordedTopic,
  RecordingError,
} from '@farpoint/recording';
import type { TopicEntry, TopicReading, TopicTable } from '@farpoint/ros';
import { ReadingTopic } from '../../ground/ros/reading-topic.ts';
import { PICTURE_TYPES, readPicture } from '../pictures/picture-message.ts';
import { RecordedTelemetry } from './recorded-telemetry.ts';
import { RecordedVideos } from './recorded-videos.ts';

/** What a recording holds for people besides its clouds: pictures and readings from the topics that the table names. */
class RecordingTopics {
  readonly cameras: readonly CameraDescription[];
  taker: PictureTaker | null = null;
  onReading: ((reading: TopicReading) => void) | null = null;
  readonly #pictures: readonly TopicEntry[];
  readonly #readings = new Map<string, ReadingTopic>();
  readonly #now: () => number;
  #perSecond: readonly number[] = [];

  /** @param now robot’s clock, ms */
  constructor(table: TopicTable, now: () => number) {
    this.#now = now;
    this.#pictures = table.filter(({ as }) => as === 'picture');
    this.cameras = this.#pictures.map(cameraOf);
    for (const entry of table)
      if (ReadingTopic.is(entry)) this.#readings.set(entry.topic, new ReadingTopic(entry));
  }

  get names(): string[] {
    return [...this.#pictures.map(({ topic }) => topic), ...this.#readings.keys()];
  }

  /** Topics that the table names and the recording lacks. The others are played. */
  missing(file: string, recorded: readonly RecordedTopic[]): RecordingError[] {
    const pictures = recorded.filter(({ type }) => PICTURE_TYPES.includes(type)).map(({ name }) => name);
    const others = `with pictures: ${pictures.join(', ') || 'none'}`;
    const faults: RecordingError[] = [];
    for (const topic of this.names) {
      const found = recorded.filter(({ name }) => name === topic);
      const fault = (detail: string) => faults.push(new RecordingError('no-topic', detail, { file, topic }));
      const isPicture = this.#camera(topic) >= 0;
      if (found.length === 0) fault(isPicture ? `no such topic; ${others}` : 'no such topic');
      else if (isPicture && !found.some(({ type }) => PICTURE_TYPES.includes(type)))
        fault(`its type is ${found[0]?.type || 'unknown'}, not pictures; ${others}`);
    }
    return faults;
  }

  /** @param perSecond pictures per second for each camera; 0: nobody watches */
  watch(perSecond: readonly number[]): void {
    this.#perSecond = perSecond;
  }

  wants(topic: string): boolean {
    return this.#readings.has(topic) || (this.#perSecond[this.#camera(topic)] ?? 0) > 0;
  }

  /** @param dueMs when it was due, on the robot's clock @throws {Error} if it cannot be read */
  take({ topic, data, offset }: RecordedMessage, dueMs: number): void {
    const now = this.#now();
    const reading = this.#readings.get(topic.name);
    if (reading !== undefined) {
      const told = reading.admits(now) ? reading.take(topic.decode(data), now) : null;
      if (told !== null) this.onReading?.(told);
      return;
    }
    const { taker } = this;
    const camera = this.#camera(topic.name);
    if (taker === null || !taker.wants(camera, now)) return;
    const { facts, data: picture } = readPicture(topic.type, topic.decode(data));
    const origin = `${topic.name}: byte ${offset}`;
    taker.offer({ camera, capturedAtMs: dueMs, facts, data: picture, origin });
  }

  #camera(topic: string): number {
    return this.#pictures.findIndex((entry) => entry.topic === topic);
  }
}

export interface RecordingSourceOptions extends Omit<PlayOptions, 'along'> {
  /** The topics to read pictures and readings from. */
  topics: TopicTable;
  /** Whether its videos are played; by default they are not. */
  videos?: boolean;
  /** Whether its quantities, alarms and components' reports are played; by default they are not. */
  telemetry?: boolean;
}

/** Assumed frame rate of a recording with a single cloud. As a depth camera's. */
const UNKNOWN_FPS = 30;

/**
 * Plays a recording's clouds at their times, with the pictures and readings that the topic table names. It has no
 * wheels: velocities change nothing.
 */
export class RecordingSource implements FrameSource {
  readonly description: SourceDescription;
  onReady: (() => void) | null = null;
  onFault: ((error: Error) => void) | null = null;
  onReading: ((reading: TopicReading) => void) | null = null;
  onTelemetry: ((message: PlayedMessage) => void) | null = null;
  onVideo: ((video: number, picture: PlayedPicture) => void) | null = null;
  /** Called at the end of the recording. */
  onEnd: (() => void) | null = null;
  readonly #player: CloudPlayer;
  readonly #topics: RecordingTopics;
  readonly #videos: RecordedVideos;
  readonly #telemetry: RecordedTelemetry;
  /** Faults found before playback starts; `null` once it has started. */
  #found: readonly Error[];
  /** For each topic other than the clouds, its last reported fault. */
  readonly #told = new Map<string, string>();

  private constructor(
    player: CloudPlayer,
    topics: RecordingTopics,
    videos: RecordedVideos,
    telemetry: RecordedTelemetry,
    missing: readonly Error[],
    now: () => number,
  ) {
    const { warning } = player;
    this.#found = warning === null ? missing : [new Error(warning), ...missing];
    const { topic, axes, width, height, capacity, framesPerSecond } = player.stream;
    this.#player = player;
    this.#topics = topics;
    this.#videos = videos;
    this.#telemetry = telemetry;
    this.description = {
      kind: `recording (${topic.name}, ${axes} frame, ${player.seconds.toFixed(1)} s)`,
      width,
      height,
      capacity,
      camera: null,
      depthMeasure: axes === 'body' ? 'range' : 'z',
      cameras: topics.cameras,
      videos: videos.videos.map(({ name }) => name),
      telemetry: telemetry.description,
      framesPerSecond: framesPerSecond ?? UNKNOWN_FPS,
    };
    player.onCloud = () => this.onReady?.();
    player.onFault = (error) => this.#tell(error);
    const runs = [...videos.topics, ...telemetry.topics];
    const always = new Set(runs);
    // Frames that nobody watches are read, too: whoever begins to watch needs those since the last key frame.
    player.wantsAlong = (name) => always.has(name) || topics.wants(name);
    player.onPass = () => {
      videos.restart();
      telemetry.restart(now());
    };
    player.playRuns(runs, (message) => this.#begins(message));
    player.onAlong = (message, dueMs) => {
      if (!videos.take(message, dueMs) && !telemetry.take(message, dueMs)) topics.take(message, dueMs);
      this.#told.delete(message.topic.name);
    };
    videos.onPicture = (video, picture) => this.onVideo?.(video, picture);
    topics.onReading = (reading) => this.onReading?.(reading);
    telemetry.onMessage = (message) => this.onTelemetry?.(message);
  }

  /** @throws {RecordingError} saying what cannot be read, and where */
  static async open(options: RecordingSourceOptions, now: () => number): Promise<RecordingSource> {
    const { topics: table, videos: playsVideos, telemetry: playsTelemetry, ...play } = options;
    const topics = new RecordingTopics(table, now);
    const player = await CloudPlayer.open({ ...play, along: topics.names }, playClock(now));
    const videos = new RecordedVideos(playsVideos === true ? player.topics : [], topics.names);
    const telemetry = new RecordedTelemetry(playsTelemetry === true ? player.topics : [], topics.names);
    const missing = topics.missing(play.path, player.topics);
    return new RecordingSource(player, topics, videos, telemetry, missing, now);
  }

  get state(): BaseState {
    const { base, battery } = this.#player;
    return { pose: base.pose, twist: base.twist, battery, contact: false };
  }

  get rings(): readonly number[] | null {
    return this.#player.decoder.rings;
  }

  start(): void {
    const found = this.#found;
    this.#found = [];
    for (const error of found) this.onFault?.(error);
    void this.#player.run().then(() => this.onEnd?.());
  }

  capture(_nowMs: number, _wishes: CaptureWishes, { points }: CaptureRoom): SourceFrame | null {
    const cloud = this.#player.take(points);
    if (cloud === null) return null;
    const { dueMs, ...rest } = cloud;
    return { form: 'points', points, ...rest, capturedAtMs: dueMs };
  }

  skip(): void {
    this.#player.skip();
  }

  usePictures(taker: PictureTaker): void {
    this.#topics.taker = taker;
  }

  watchPictures(perSecond: readonly number[]): void {
    this.#topics.watch(perSecond);
  }

  /** Whether somebody watches a video: it is played even if nobody takes the clouds. */
  get goesOn(): boolean {
    return this.#videos.watched;
  }

  watchVideo(video: number, watched: boolean): void {
    this.#videos.watch(video, watched);
  }

  close(): void {
    void this.#player.close();
  }

  /**
   * Of the robot's telemetry, the newest message is enough. What cannot be read begins nothing; its fault is reported
   * when it is due.
   */
  #begins(message: RecordedMessage): boolean {
    if (this.#telemetry.topics.includes(message.topic.name)) return true;
    try {
      return this.#videos.begins(message);
    } catch {
      return false;
    }
  }

  /** Reports a topic once if all its pictures have the same fault. */
  #tell(error: RecordingError): void {
    const { topic, code, detail } = error;
    const others = [...this.#topics.names, ...this.#videos.topics, ...this.#telemetry.topics];
    if (topic !== undefined && others.includes(topic)) {
      const what = `${code}: ${detail}`;
      if (this.#told.get(topic) === what) return;
      this.#told.set(topic, what);
    }
    this.onFault?.(error);
  }
}

function playClock(now: () => number): PlayClock {
  return {
    now,
    wait: async (ms, signal) => {
      // Aborting ends the wait. The caller checks the signal.
      await delay(ms, undefined, { signal }).catch(() => {});
    },
  };
}
