import type { Battery, Pose } from '@farpoint/protocol';
import { type BaseMotion, PointCloud2Decoder, pointCloud2Schema, stampNs, WorldState } from '@farpoint/ros';
import { type CloudStream, describeClouds } from './cloud-stream.ts';
import { codeOf, detailOf, RecordingError } from './errors.ts';
import { Lead } from './lead.ts';
import { openRecording } from './open-recording.ts';
import type { PlayOptions } from './play-options.ts';
import { type PlayClock, PlayTimeline } from './play-timeline.ts';
import { PREROLL_NS, readAhead } from './read-ahead.ts';
import type { RecordedMessage, RecordedTopic, Recording } from './recording.ts';

export interface PlayedCloud {
  count: number;
  /** Pose of the optical frame in the world. */
  cameraPose: Pose;
  /** When it was due, by the player's clock, ms. */
  dueMs: number;
}

/** If nobody has taken a cloud for this long, the recording pauses until somebody does, ms. */
const IDLE_MS = 1000;
const MOST_STATIC = 10_000;

/**
 * Plays the clouds of one topic at their times, with the poses from tf and odometry, together with other topics. It
 * holds one cloud, the messages up to a tenth of a second after it, and the chunk of the file that is being read,
 * whatever the file's size.
 */
export class CloudPlayer {
  readonly stream: CloudStream;
  /** Knows the rings of the LiDAR, too, once it has decoded clouds that tell. */
  readonly decoder = new PointCloud2Decoder();
  /** Called for each cloud: {@link take} it or {@link skip} it before the next one, which otherwise replaces it. */
  onCloud: (() => void) | null = null;
  /** Whether somebody wants the messages of an accompanying topic; otherwise they are skipped while reading. */
  wantsAlong: (topic: string) => boolean = () => true;
  /**
   * Called for each of these messages. Its memory belongs to the receiver; an exception is reported as a fault of the
   * message.
   *
   * @param dueMs when it was due, by the player's clock: before now for a message before the first cloud, which is shown
   * together with that cloud
   */
  onAlong: ((message: RecordedMessage, dueMs: number) => void) | null = null;
  /** Called whenever playing begins anew, at the start, after a jump and at each repetition. */
  onPass: (() => void) | null = null;
  /** Called when something is wrong with the recording. Playing continues after it, or has ended for good. */
  onFault: ((error: RecordingError) => void) | null = null;
  /** Clouds that were due, and how many of them nobody took in time. */
  played = 0;
  superseded = 0;
  readonly #recording: Recording;
  readonly #options: PlayOptions;
  readonly #clock: PlayClock;
  readonly #timeline: PlayTimeline;
  readonly #state: WorldState;
  readonly #ended = new AbortController();
  #passEnd = new AbortController();
  #fromNs: bigint;
  #ready: RecordedMessage | null = null;
  #runs: readonly string[] = [];
  #beginsRun: (message: RecordedMessage) => boolean = () => true;
  #readySinceMs = 0;
  #claims = 0;
  #onClaim: (() => void) | null = null;

  private constructor(recording: Recording, stream: CloudStream, options: PlayOptions, clock: PlayClock) {
    this.#recording = recording;
    this.stream = stream;
    this.#options = options;
    this.#clock = clock;
    this.#state = new WorldState(undefined, options.baseFrame);
    this.#timeline = new PlayTimeline(clock, options.rate);
    this.#fromNs = recording.startNs + BigInt(Math.round(options.fromS * 1e9));
  }

  /** @throws {RecordingError} if the file is unreadable or has no such clouds */
  static async open(options: PlayOptions, clock: PlayClock): Promise<CloudPlayer> {
    const recording = await openRecording(options.path);
    try {
      const { startNs, endNs } = recording;
      const seconds = Number(endNs - startNs) / 1e9;
      if (options.fromS > seconds) {
        const what = `it has ${seconds.toFixed(1)} s, none to play from ${options.fromS} s`;
        throw new RecordingError('no-topic', what, { file: options.path });
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

  /** A problem of the file that does not prevent playing it. */
  get warning(): string | null {
    return this.#recording.warning;
  }

  /** The topics of the recording. */
  get topics(): readonly RecordedTopic[] {
    return this.#recording.topics;
  }

  /** Its length, s. */
  get seconds(): number {
    return Number(this.#recording.endNs - this.#recording.startNs) / 1e9;
  }

  /** Where the robot is, and how it moves as far as the recording says it. */
  get base(): BaseMotion {
    return this.#state.base;
  }

  get battery(): Battery | null {
    return this.#state.battery;
  }

  /**
   * Delivers these topics along with the clouds, too. Their messages build on each other, as a video's frames do: before
   * the first cloud, all are delivered that are needed for the newest one. Call it before {@link run}.
   *
   * @param begins whether a message can be used without those before it
   */
  playRuns(topics: readonly string[], begins: (message: RecordedMessage) => boolean): void {
    this.#runs = topics;
    this.#beginsRun = begins;
  }

  /** Starts playing; returns when there is nothing more to play. */
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

  /** Continues from another position, s after the first message. */
  seek(seconds: number): void {
    this.#fromNs = this.#recording.startNs + BigInt(Math.round(Math.max(0, seconds) * 1e9));
    this.#ready = null;
    this.#passEnd.abort();
    this.#onClaim?.();
  }

  /**
   * Decodes the cloud that is due.
   *
   * @param into as in {@link PointCloud2Decoder.decode}
   * @returns `null` if there is none, or it cannot be read, which `onFault` reports
   */
  take(into: Float32Array): PlayedCloud | null {
    const message = this.#ready;
    if (message === null) return null;
    this.skip();
    const dueMs = this.#timeline.dueMs(message.logNs);
    try {
      const cloud = pointCloud2Schema.parse(message.topic.decode(message.data));
      const { axes } = this.stream;
      const count = this.decoder.decode(cloud, axes, into);
      const { frame_id, stamp } = cloud.header;
      const { cameraPose } = this.#state.placeByStamp(frame_id, stampNs(stamp), axes);
      return { count, cameraPose, dueMs };
    } catch (error) {
      this.#fault(error, message);
      return null;
    }
  }

  /** Discards the cloud that is due. */
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

  /** Plays once, from the beginning or the start position, to the end. */
  async #pass(signal: AbortSignal): Promise<void> {
    const { topic } = this.stream;
    this.#state.forgetMoving();
    this.#timeline.clear();
    this.onPass?.();
    const along = new Set([...(this.#options.along ?? []), ...this.#runs]);
    along.delete(topic.name);
    const runs = new Set(this.#runs);
    const lead = new Lead(runs);
    const shown = readAhead(this.#recording, {
      cloud: topic.name,
      states: new Set(WorldState.topicsOf(this.#recording.topics).map(({ name }) => name)),
      along,
      hasRuns: runs.size > 0,
      fromNs: this.#fromNs,
      wants: (name) => this.wantsAlong(name),
      onState: (message) => this.#takeState(message),
      onFault: (error, where) => this.#fault(error, where),
    });
    for await (const { message, isCloud } of shown) {
      if (signal.aborted) return;
      if (isCloud) await this.#show(message, lead, signal);
      else if (!this.#timeline.running) lead.add(message, this.#beginsRun);
      else {
        await this.#timeline.until(message.logNs, signal);
        if (!signal.aborted) this.#tellAlong(message);
      }
      if (signal.aborted) return;
    }
  }

  /** Shows a message at its time, and only while somebody watches. */
  async #show(message: RecordedMessage, lead: Lead, signal: AbortSignal): Promise<void> {
    await this.#timeline.until(message.logNs, signal);
    if (this.#ready !== null) {
      const idleMs = this.#clock.now() - this.#readySinceMs;
      if (this.#claims === 0 || idleMs >= IDLE_MS) {
        await new Promise<void>((resolve) => {
          this.#onClaim = resolve;
          if (signal.aborted) resolve();
        });
        this.#onClaim = null;
        this.#timeline.begin(message.logNs);
      }
    }
    if (signal.aborted) return;
    if (this.#ready === null) this.#readySinceMs = this.#clock.now();
    else this.superseded++;
    this.#ready = message;
    this.played++;
    for (const each of lead.take(message.logNs - PREROLL_NS)) this.#tellAlong(each);
    this.onCloud?.();
  }

  #tellAlong(message: RecordedMessage): void {
    try {
      this.onAlong?.(message, this.#timeline.dueMs(message.logNs));
    } catch (error) {
      this.#fault(error, message);
    }
  }

  #takeState(message: RecordedMessage): void {
    try {
      const left = this.#state.take(message.topic, message.topic.decode(message.data));
      if (left !== null) throw new Error(left);
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
      // Damage is reported when playing reaches it.
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
