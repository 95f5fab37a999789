/** Watches a robot through Janus: receives what it broadcasts, and sends it nothing. */
import { StreamingClient, type StreamingEvent } from '@farpoint/janus';
import { type Broadcast, broadcastCodec, decodeJson, ProtocolError } from '@farpoint/protocol';
import { Backoff, WindowedMinimum } from '@farpoint/timing';
import { Emitter } from '../client/emitter.ts';
import type { Batch } from '../cloud/batch.ts';
import { CloudReceiver } from '../cloud/cloud-receiver.ts';
import type { TransformSupport } from '../peer/encoded-transform.ts';
import { CaptureTimes } from './capture-times.ts';
import type { FromStampWorker } from './stamp-messages.ts';
import { WatchPeer } from './watch-peer.ts';
import {
  obstacleOf,
  type WatchEvents,
  type WatchObstacle,
  type WatchPhase,
  type WatchState,
} from './watch-state.ts';

/** What a {@link RobotWatcher} is made with. */
export interface RobotWatcherOptions {
  /** Janus' WebSocket. */
  url: string;
  /** Number of the robot's mountpoint. */
  mountpoint: number;
  /** The mountpoint's PIN, if it has one. */
  pin?: string | undefined;
  /** STUN or TURN servers; Janus is usually reachable without. */
  iceServers?: readonly RTCIceServer[] | undefined;
  /** As {@link transformSupport} says. */
  transform: TransformSupport;
}

/** How often silence is looked for, ms: a sixth of what follows. */
const CHECK_EVERY_MS = 250;
/**
 * Without media for so long, nothing live is shown, ms. Chosen: later than for a driver, 1 s, because nothing
 * is driven by it.
 */
const SILENT_MS = 1500;
/**
 * The first and the longest wait before Janus is asked again, ms: it doubles. Chosen: the page is back soon
 * after Janus is; the robot itself waits about as long (mountpoint-keeper.ts).
 */
const FIRST_RETRY_MS = 300;
const MOST_RETRY_MS = 4000;
/** The fastest of the last frames tells the difference of the clocks, ms. */
const CLOCK_WINDOW_MS = 10_000;

/**
 * Watches a robot through Janus: receives what it broadcasts, and sends it nothing. `CloudView` of
 * `@farpoint/cloud-view` draws its clouds.
 */
export class RobotWatcher {
  /** When points last arrived, `performance.now()`. */
  pointsAtMs = 0;
  /** There are no latency tests: nothing goes to the robot. */
  readonly latency: {
    /** Always `false`. */
    readonly wantsTime: boolean;
  } = { wantsTime: false };
  /**
   * The difference of the clocks as far as it can be known: as if the fastest of the last frames had taken no time.
   * Instants are comparable with each other, but no delay can be told from them.
   */
  readonly link: {
    /** What is known of the present attempt. */
    readonly session: {
      /** The robot's clock. */
      readonly clock: {
        /** Robot's clock minus page's clock, ms; `null` before the first frame. */
        offsetMs: number | null;
      };
    };
  } = { session: { clock: { offsetMs: null } } };
  /** How often it began to watch. */
  attempts = 0;
  readonly #options: RobotWatcherOptions;
  readonly #emitter = new Emitter<WatchEvents>();
  readonly #receiver: CloudReceiver;
  readonly #stampWorker: Worker;
  readonly #backoff = new Backoff({ firstMs: FIRST_RETRY_MS, mostMs: MOST_RETRY_MS, random: Math.random });
  #state: WatchState = { phase: 'connecting', obstacle: null, detail: '' };
  #broadcast: Broadcast | null = null;
  #generation = 0;
  #times: CaptureTimes[] = [];
  #delays = new WindowedMinimum(CLOCK_WINDOW_MS);
  #client: StreamingClient | null = null;
  #peer: WatchPeer | null = null;
  #mediaAtMs = 0;
  #retry: ReturnType<typeof setTimeout> | undefined;
  #checking: ReturnType<typeof setInterval> | undefined;
  #closed = false;

  /** Makes a watcher that does nothing until {@link start} is called. */
  constructor(options: RobotWatcherOptions) {
    this.#options = options;
    this.#receiver = new CloudReceiver({
      onBatch: (batch) => this.#onBatch(batch),
      onReport: () => undefined,
      onStreamRefused: (format, detail) => console.warn('cloud stream:', format, detail),
      onFailed: (detail) => this.#emitter.emit('failed', { reason: 'cloud-worker', detail }),
    });
    this.#stampWorker = new Worker(new URL('./stamp-worker.ts', import.meta.url), { type: 'module' });
    this.#stampWorker.onmessage = ({ data }: MessageEvent<FromStampWorker>) => this.#onStamp(data);
  }

  /**
   * Calls `listener` for each event of the type; see {@link WatchEvents}.
   *
   * @returns a function that removes the listener
   */
  on<Type extends keyof WatchEvents>(type: Type, listener: (event: WatchEvents[Type]) => void): () => void {
    return this.#emitter.on(type, listener);
  }

  /** Whether anything can be seen now, and why not. */
  get state(): WatchState {
    return this.#state;
  }

  /** Begins to watch, and begins again whenever that ends. */
  start(): void {
    if (this.#closed || this.#checking !== undefined) return;
    this.#checking = setInterval(() => this.#checkSilence(performance.now()), CHECK_EVERY_MS);
    void this.#attempt();
  }

  /** Ends it and frees everything. The watcher cannot be started again. */
  close(): void {
    this.#closed = true;
    clearInterval(this.#checking);
    clearTimeout(this.#retry);
    this.#drop();
    this.#receiver.close();
    this.#stampWorker.terminate();
  }

  /** When a video's frame was captured, by the RTP timestamp that it came with: ms on the robot's clock, or `null`. */
  captureMsOf(video: number, rtpTimestamp: number): number | null {
    return this.#times[video]?.of(rtpTimestamp) ?? null;
  }

  /** Returns a batch of a `cloud` event. Its buffer is detached afterwards. */
  release(batch: Batch): void {
    this.#receiver.release(batch);
  }

  /** Draws only one of every N points, of coded clouds and of samples. */
  drawEvery(every: number, everySample = 1): void {
    this.#receiver.drawEvery(every, everySample);
  }

  /** Whether clouds on a camera's grid come as tiles of a surface, from their next frame on. Default: as points. */
  drawSurface(wanted: boolean): void {
    this.#receiver.drawSurface(wanted);
  }

  /** For `CloudView`; does nothing, because there is nothing to measure. */
  noteUploaded(): void {}

  /** For `CloudView`; does nothing, because there is nothing to measure. */
  noteDrawn(): void {}

  async #attempt(): Promise<void> {
    this.#enter('connecting');
    const generation = ++this.#generation;
    this.attempts = generation;
    const { url, mountpoint, pin = null } = this.#options;
    try {
      const client = await StreamingClient.connect(
        { open: () => new WebSocket(url, 'janus-protocol') },
        {
          onEvent: (event, jsep) => this.#onEvent(generation, event, jsep?.sdp),
          onCandidate: (candidate) => void this.#peer?.candidate(candidate),
          onHangup: (reason) => this.#lose(generation, 'lost', reason),
          onClosed: (failure) => this.#lose(generation, 'lost', failure.message),
        },
      );
      if (this.#closed) {
        client.close();
        return;
      }
      this.#client = client;
      const { metadata } = await client.info(mountpoint);
      this.#begin(generation, decodeJson(broadcastCodec, metadata ?? ''));
      await client.watch(mountpoint, pin);
    } catch (error) {
      this.#lose(generation, obstacleOf(error), error instanceof Error ? error.message : String(error));
    }
  }

  #begin(generation: number, broadcast: Broadcast): void {
    this.#times = broadcast.videos.map(() => new CaptureTimes());
    this.#delays = new WindowedMinimum(CLOCK_WINDOW_MS);
    this.link.session.clock.offsetMs = null;
    this.#receiver.begin(generation);
    this.#emitter.emit('session', generation);
    this.#describe(broadcast);
    this.#peer = new WatchPeer(
      {
        broadcast,
        generation,
        cloudWorker: this.#receiver.worker,
        stampWorker: this.#stampWorker,
        iceServers: this.#options.iceServers ?? [],
        transform: this.#options.transform,
      },
      {
        onCandidate: (candidate) => this.#client?.trickle(candidate),
        onVideoTrack: (track) => this.#emitter.emit('videoTrack', track),
        onConnected: () => {
          if (this.#state.phase === 'connecting') this.#enter('opening');
        },
        onFailed: (detail) => this.#lose(generation, 'lost', detail),
      },
    );
  }

  #onEvent(generation: number, event: StreamingEvent, offer: string | undefined): void {
    if (generation !== this.#generation) return;
    if ('error' in event) this.#lose(generation, 'refused', event.error);
    else if ('metadata' in event) this.#onMetadata(generation, event.metadata);
    else if (event.result.status === 'stopped') this.#lose(generation, 'lost', 'the broadcast has ended');
    else if (offer !== undefined) void this.#answer(generation, offer);
  }

  async #answer(generation: number, offer: string): Promise<void> {
    try {
      const sdp = await this.#peer?.answer(offer);
      if (generation === this.#generation && sdp !== undefined)
        await this.#client?.start({ type: 'answer', sdp });
    } catch (error) {
      this.#lose(generation, obstacleOf(error), error instanceof Error ? error.message : String(error));
    }
  }

  #onMetadata(generation: number, metadata: string): void {
    try {
      this.#describe(decodeJson(broadcastCodec, metadata));
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.#lose(generation, 'not-a-broadcast', error.message);
    }
  }

  #describe(broadcast: Broadcast): void {
    const before = this.#broadcast;
    this.#broadcast = broadcast;
    for (const stream of broadcast.clouds?.streams ?? []) this.#receiver.beginStream(stream);
    this.#emitter.emit('broadcast', broadcast);
    const sensors = broadcast.clouds?.sensors ?? [];
    if (before === null || sensors.length !== (before.clouds?.sensors.length ?? 0))
      this.#emitter.emit('sensors', sensors);
    this.#emitter.emit('videos', broadcast.videos);
  }

  #onBatch(batch: Batch): void {
    const type = batch.sensor === 0 ? 'cloud' : (`cloud:${batch.sensor}` as const);
    this.pointsAtMs = performance.now();
    this.#onMedia(this.pointsAtMs);
    if (!this.#emitter.emit(type, batch)) this.release(batch);
  }

  #onStamp({ generation, video, rtpTimestamp, captureMs }: FromStampWorker): void {
    if (generation !== this.#generation) return;
    const nowMs = performance.now();
    this.#onMedia(nowMs);
    if (captureMs === null) return;
    this.#times[video]?.note(rtpTimestamp, captureMs);
    this.#delays.add(nowMs - captureMs, nowMs);
    this.link.session.clock.offsetMs = -this.#delays.value;
  }

  #onMedia(nowMs: number): void {
    this.#mediaAtMs = nowMs;
    const { phase } = this.#state;
    if (phase === 'live' || phase === 'waiting') return;
    this.#backoff.reset();
    this.#enter('live');
  }

  #checkSilence(nowMs: number): void {
    if (this.#state.phase === 'live' && nowMs - this.#mediaAtMs > SILENT_MS) this.#enter('silent');
  }

  #lose(generation: number, obstacle: WatchObstacle, detail: string): void {
    if (this.#closed || generation !== this.#generation || this.#state.phase === 'waiting') return;
    this.#drop();
    this.#enter('waiting', obstacle, detail);
    this.#retry = setTimeout(() => void this.#attempt(), this.#backoff.nextMs());
  }

  #drop(): void {
    this.#peer?.close();
    this.#client?.close();
    this.#peer = null;
    this.#client = null;
  }

  #enter(phase: WatchPhase, obstacle: WatchObstacle | null = null, detail = ''): void {
    const wasSeen = isSeen(this.#state);
    this.#state = { phase, obstacle, detail };
    this.#emitter.emit('watching', this.#state);
    const seen = isSeen(this.#state);
    if (seen !== wasSeen) this.#emitter.emit('phase', seen ? 'live' : 'waiting');
  }
}

function isSeen({ phase }: WatchState): boolean {
  return phase === 'live' || phase === 'silent';
}
