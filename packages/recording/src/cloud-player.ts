import type { Battery, Pose, Twist } from '@farpoint/protocol';
import { type CloudAxes, PointCloud2Decoder, pointCloud2Schema, stampNs, WorldState } from '@farpoint/ros';
import { type CloudStream, describeClouds } from './cloud-stream.ts';
import { codeOf, detailOf, RecordingError } from './errors.ts';
import { openRecording } from './open-recording.ts';
import type { RecordedMessage, Recording } from './recording.ts';

export interface PlayOptions {
  /** An MCAP file or a ROS 1 bag. */
  path: string;
  /** Of the clouds; `null`: the topic with most clouds. */
  topic: string | null;
  /** 1 as it was recorded, 2 twice as fast. */
  rate: number;
  /** Where to begin, s after the first message. */
  fromS: number;
  atEnd: 'repeat' | 'stop';
  /** `auto`: optical where the frame's name says so (REP-103), else body. */
  axes: CloudAxes | 'auto';
}

export interface PlayClock {
  /** Any fixed beginning, ms. */
  now(): number;
  /** Ends early, without an error, when the signal is aborted. */
  wait(ms: number, signal: AbortSignal): Promise<void>;
}

export interface PlayedCloud {
  count: number;
  /** The optical frame in the world. */
  cameraPose: Pose;
}

/** Nobody took a cloud for so long: the recording stands still until somebody does, ms. */
const IDLE_MS = 1000;
/** More behind than this, it goes on from where it is, ms. */
const LATE_MS = 500;
/** How far after a cloud poses are read before it is shown, ns: they come later than what they are of. */
const LOOK_AHEAD_NS = 100_000_000n;
/** How far before the beginning they are read, ns. */
const PREROLL_NS = 1_000_000_000n;
const MOST_STATIC = 10_000;

/**
 * Plays the clouds of one topic at their times, with the poses that tf and odometry give. It holds one cloud and the
 * chunk of the file that is being read, whatever the file's size.
 */
export class CloudPlayer {
  readonly stream: CloudStream;
  /** Called at each cloud: {@link take} it or {@link skip} it before the next, or the next takes its place. */
  onCloud: (() => void) | null = null;
  /** What is wrong with the recording: it goes on after it, or has ended for good. */
  onFault: ((error: RecordingError) => void) | null = null;
  /** Clouds that were due, and those of them that nobody took in time. */
  played = 0;
  superseded = 0;
  readonly #recording: Recording;
  readonly #options: PlayOptions;
  readonly #clock: PlayClock;
  readonly #state = new WorldState();
  readonly #decoder = new PointCloud2Decoder();
  readonly #ended = new AbortController();
  #passEnd = new AbortController();
  #fromNs: bigint;
  #ready: RecordedMessage | null = null;
  #readySinceMs = 0;
  #claims = 0;
  #onClaim: (() => void) | null = null;
  /** A moment of the clock and the time of the recording at it. */
  #anchor: { ms: number; ns: bigint } | null = null;

  private constructor(recording: Recording, stream: CloudStream, options: PlayOptions, clock: PlayClock) {
    this.#recording = recording;
    this.stream = stream;
    this.#options = options;
    this.#clock = clock;
    this.#fromNs = recording.startNs + BigInt(Math.round(options.fromS * 1e9));
  }

  /** @throws {RecordingError} for a file that cannot be read, and one without such clouds */
  static async open(options: PlayOptions, clock: PlayClock): Promise<CloudPlayer> {
    const recording = await openRecording(options.path);
    try {
      const { startNs, endNs } = recording;
      const seconds = Number(endNs - startNs) / 1e9;
      if (options.fromS > seconds) {
        throw new RecordingError(
          'no-topic',
          `it has ${seconds.toFixed(1)} s, none to play from ${options.fromS} s`,
          {
            file: options.path,
          },
        );
      }
      const stream = await describeClouds(recording, options);
      const player = new CloudPlayer(recording, stream, options, clock);
      await player.#readStatic();
      return player;
    } catch (error) {
      await recording.close();
      throw error;
    }
  }

  /** Something that is wrong with the file and does not keep it from being played. */
  get warning(): string | null {
    return this.#recording.warning;
  }

  /** Length of the recording, s. */
  get seconds(): number {
    return Number(this.#recording.endNs - this.#recording.startNs) / 1e9;
  }

  get pose(): Pose {
    return this.#state.basePose;
  }

  get twist(): Twist {
    return this.#state.twist;
  }

  get battery(): Battery | null {
    return this.#state.battery;
  }

  /** Begins; returns when there is nothing more to play. */
  async run(): Promise<void> {
    while (!this.#ended.signal.aborted) {
      const before = this.played;
      this.#passEnd = new AbortController();
      const signal = AbortSignal.any([this.#passEnd.signal, this.#ended.signal]);
      let failed = false;
      try {
        await this.#pass(signal);
      } catch (error) {
        if (this.#ended.signal.aborted) return;
        failed = true;
        this.#fault(error, {});
      }
      if (this.#passEnd.signal.aborted) continue;
      if (this.#options.atEnd === 'stop') return;
      if (this.played === before) {
        if (!failed) this.#fault(new RecordingError('no-topic', 'no cloud from there on'), {});
        return;
      }
    }
  }

  /** Goes on from another place, s after the first message. */
  seek(seconds: number): void {
    this.#fromNs = this.#recording.startNs + BigInt(Math.round(Math.max(0, seconds) * 1e9));
    this.#passEnd.abort();
    this.#onClaim?.();
  }

  /**
   * Decodes the cloud that is due.
   *
   * @param into as {@link PointCloud2Decoder.decode} has it
   * @returns `null` where there is none, or it cannot be read: then `onFault` was told
   */
  take(into: Float32Array): PlayedCloud | null {
    const message = this.#ready;
    if (message === null) return null;
    this.skip();
    try {
      const cloud = pointCloud2Schema.parse(message.topic.decode(message.data));
      const { axes } = this.stream;
      const count = this.#decoder.decode(cloud, axes, into);
      const { frame_id, stamp } = cloud.header;
      return { count, cameraPose: this.#state.opticalPose(frame_id, stampNs(stamp), axes) };
    } catch (error) {
      this.#fault(error, message);
      return null;
    }
  }

  /** Lets the cloud go that is due. */
  skip(): void {
    this.#ready = null;
    this.#claims++;
    this.#onClaim?.();
  }

  async close(): Promise<void> {
    this.#ended.abort();
    this.#onClaim?.();
    await this.#recording.close();
  }

  /** From the beginning, or where it was told to begin, to the end. */
  async #pass(signal: AbortSignal): Promise<void> {
    const { topic } = this.stream;
    const fromNs = this.#fromNs;
    this.#state.forgetMoving();
    this.#anchor = null;
    const names = [topic.name, ...WorldState.topicsOf(this.#recording.topics).map(({ name }) => name)];
    let pending: RecordedMessage | null = null;
    const onDamage = (fault: RecordingError) => this.#fault(fault, {});
    for await (const message of this.#recording.messages(names, fromNs - PREROLL_NS, onDamage)) {
      if (signal.aborted) return;
      const isCloud = message.topic.name === topic.name;
      if (pending !== null && (isCloud || message.logNs - pending.logNs > LOOK_AHEAD_NS)) {
        await this.#show(pending, signal);
        pending = null;
        if (signal.aborted) return;
      }
      if (!isCloud) this.#takeState(message);
      else if (message.logNs >= fromNs) pending = message;
    }
    if (pending !== null) await this.#show(pending, signal);
  }

  /** At its time, and only while somebody watches. */
  async #show(message: RecordedMessage, signal: AbortSignal): Promise<void> {
    const now = this.#clock.now();
    this.#anchor ??= { ms: now, ns: message.logNs };
    const sinceMs = Number(message.logNs - this.#anchor.ns) / 1e6 / this.#options.rate;
    const waitMs = this.#anchor.ms + sinceMs - now;
    if (waitMs > 0) await this.#clock.wait(waitMs, signal);
    else if (waitMs < -LATE_MS) this.#anchor = { ms: now, ns: message.logNs };
    if (this.#ready !== null) {
      const idleMs = this.#clock.now() - this.#readySinceMs;
      if (this.#claims === 0 || idleMs >= IDLE_MS) {
        await new Promise<void>((resolve) => {
          this.#onClaim = resolve;
          if (signal.aborted) resolve();
        });
        this.#onClaim = null;
        this.#anchor = { ms: this.#clock.now(), ns: message.logNs };
      }
    }
    if (signal.aborted) return;
    if (this.#ready === null) this.#readySinceMs = this.#clock.now();
    else this.superseded++;
    this.#ready = message;
    this.played++;
    this.onCloud?.();
  }

  #takeState(message: RecordedMessage): void {
    try {
      this.#state.take(message.topic, message.topic.decode(message.data));
    } catch (error) {
      this.#fault(error, message);
    }
  }

  async #readStatic(): Promise<void> {
    const names = WorldState.staticTopicsOf(this.#recording.topics).map(({ name }) => name);
    if (names.length === 0) return;
    let count = 0;
    try {
      for await (const message of this.#recording.messages(names, this.#recording.startNs, () => {})) {
        this.#takeState(message);
        if (++count >= MOST_STATIC) return;
      }
    } catch {
      // Where the file is damaged is said when it is played up to there.
    }
  }

  #fault(error: unknown, where: { topic?: { name: string }; offset?: number }): void {
    const known = error instanceof RecordingError ? error : null;
    this.onFault?.(
      known !== null && known.offset !== undefined
        ? known
        : new RecordingError(codeOf(error), detailOf(error), {
            file: this.#recording.file,
            ...(where.topic === undefined ? {} : { topic: where.topic.name }),
            ...(where.offset === undefined ? {} : { offset: where.offset }),
            cause: error,
          }),
    );
  }
}
