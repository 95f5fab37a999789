import type { RosGraph } from '@farpoint/ros';
import { Backoff, MEDIA_RETRY } from '@farpoint/timing';
import type { VideoEncoder as EncoderElement } from '@farpoint/video';
import { monotonicMs } from '../../../ground/clock.ts';
import { type GraphOptions, openGraph } from '../../../ground/ros/open-graph.ts';
import { wallNs } from '../../../ground/wall-clock.ts';
import { ProcessEncoder } from '../process-encoder.ts';
import type { VideoEncoder, VideoEncoderEvents, VideoLog } from '../video-encoder.ts';
import type { EncodedFormat } from '../video-plan.ts';
import type { Feed, FeedEvents, FeedTarget } from './feed.ts';
import type { FeedReport, FeedRequest, RunId } from './feed-messages.ts';
import type { FeedSource } from './feed-source.ts';
import { RosVideoFeed } from './ros-video-feed.ts';
import { SimVideoCameras } from './sim-video-feed.ts';

/** Opens what feeds the target. What it throws is the camera's fault, and tried again. */
export type OpenFeed = (target: FeedTarget, events: FeedEvents) => Promise<Feed>;

/** A camera's encoder, and what feeds it. */
class FedEncoder implements VideoEncoder {
  readonly #encoder: ProcessEncoder;
  readonly #openFeed: OpenFeed;
  readonly #events: VideoEncoderEvents;
  readonly #backoff = new Backoff({ ...MEDIA_RETRY, random: Math.random });
  #feed: Feed | null = null;
  #retry: NodeJS.Timeout | null = null;
  #closed = false;

  constructor(
    encoder: EncoderElement,
    format: EncodedFormat,
    openFeed: OpenFeed,
    events: VideoEncoderEvents,
    log: VideoLog,
  ) {
    this.#openFeed = openFeed;
    this.#events = events;
    this.#encoder = new ProcessEncoder({ source: { kind: 'frames' }, encoder }, format, events, log);
    void this.#begin();
  }

  get dropped(): number {
    return this.#encoder.dropped;
  }

  configure(format: EncodedFormat): void {
    this.#encoder.configure(format);
  }

  requestKeyFrame(): void {
    this.#encoder.requestKeyFrame();
  }

  async close(): Promise<void> {
    this.#closed = true;
    if (this.#retry !== null) clearTimeout(this.#retry);
    this.#feed?.close();
    await this.#encoder.close();
  }

  async #begin(): Promise<void> {
    try {
      const feed = await this.#openFeed(this.#encoder.process, {
        onFault: (fault) => {
          if (!this.#closed) this.#events.onFault(fault);
        },
      });
      if (this.#closed) feed.close();
      else this.#feed = feed;
    } catch (error) {
      if (this.#closed) return;
      this.#events.onFault(error instanceof Error ? error.message : String(error));
      this.#retry = setTimeout(() => void this.#begin(), this.#backoff.nextMs());
    }
  }
}

/**
 * How often silence is looked for, drops are told, and the thread says that it lives, ms. Ten times before
 * silence counts; the other side looks as often (feed-thread.ts).
 */
const CHECK_MS = 500;

/** The cameras of the thread that feeds them: does what the main thread asks for, and reports what comes of it. */
export class FeedCameras {
  readonly #report: (report: FeedReport, transfer?: ArrayBuffer[]) => void;
  readonly #graphs = new Graphs();
  readonly #simulated = new SimVideoCameras();
  readonly #runs = new Map<RunId, { encoder: FedEncoder; dropped: number }>();
  readonly #topics = new Set<RosVideoFeed>();
  readonly #checking: NodeJS.Timeout;

  /** @param report sends to the main thread; buffers in `transfer` are transferred */
  constructor(report: (report: FeedReport, transfer?: ArrayBuffer[]) => void) {
    this.#report = report;
    this.#checking = setInterval(() => this.#check(), CHECK_MS);
  }

  onRequest(request: FeedRequest): void {
    if (request.type === 'open') this.#openRun(request);
    else if (request.type === 'end') void this.close();
    else {
      const encoder = this.#runs.get(request.run)?.encoder;
      if (request.type === 'configure') encoder?.configure(request.format);
      else if (request.type === 'key-frame') encoder?.requestKeyFrame();
      else void this.#closeRun(request.run);
    }
  }

  async close(): Promise<void> {
    clearInterval(this.#checking);
    await Promise.all([...this.#runs.keys()].map((run) => this.#closeRun(run)));
    await this.#graphs.close();
  }

  #openRun({ run, source, encoder, format }: Extract<FeedRequest, { type: 'open' }>): void {
    const opened = new FedEncoder(encoder, format, this.#openFeed(source), this.#events(run), this.#log(run));
    this.#runs.set(run, { encoder: opened, dropped: 0 });
  }

  async #closeRun(run: RunId): Promise<void> {
    const closing = this.#runs.get(run);
    this.#runs.delete(run);
    await closing?.encoder.close();
    this.#report({ type: 'closed', run });
  }

  #openFeed(source: FeedSource): OpenFeed {
    if (source.kind === 'sim') return (target) => this.#simulated.open(source, target);
    return async (target, events) => {
      const graph = await this.#graphs.join(source.graph);
      const clock = { now: monotonicMs, wallNs };
      const feed = new RosVideoFeed(graph, source.entry, clock, target, events);
      this.#topics.add(feed);
      return {
        close: () => {
          this.#topics.delete(feed);
          feed.close();
        },
      };
    };
  }

  #events(run: RunId): VideoEncoderEvents {
    let told: string | null = null;
    return {
      onPicture: (picture) => {
        // Its bytes lie in memory with other messages of the process.
        const bytes = new Uint8Array(picture.bytes);
        this.#report({ type: 'picture', run, picture: { ...picture, bytes } }, [bytes.buffer]);
      },
      onFault: (fault, reason) => {
        if (fault === told && reason === undefined) return;
        told = fault;
        this.#report({ type: 'fault', run, fault, reason });
      },
    };
  }

  #log(run: RunId): VideoLog {
    const to = (level: keyof VideoLog) => (fields: object, message: string) =>
      this.#report({ type: 'log', run, level, fields, message });
    return { debug: to('debug'), info: to('info'), warn: to('warn'), error: to('error') };
  }

  #check(): void {
    this.#report({ type: 'alive' });
    const now = monotonicMs();
    for (const topic of this.#topics) topic.check(now);
    for (const [run, state] of this.#runs) {
      const { dropped } = state.encoder;
      if (dropped === state.dropped) continue;
      state.dropped = dropped;
      this.#report({ type: 'dropped', run, dropped });
    }
  }
}

/** The ROS graphs of a thread: each is joined once, when the first of its topics is needed. */
export class Graphs {
  readonly #open: (options: GraphOptions) => Promise<RosGraph>;
  readonly #graphs = new Map<string, Promise<RosGraph>>();

  constructor(open = (options: GraphOptions) => openGraph(options, 'video')) {
    this.#open = open;
  }

  /** @throws {RosFault} if it cannot be joined; the next call tries again */
  async join(options: GraphOptions): Promise<RosGraph> {
    const key = JSON.stringify(options);
    const joined = this.#graphs.get(key) ?? this.#open(options);
    this.#graphs.set(key, joined);
    try {
      return await joined;
    } catch (error) {
      this.#graphs.delete(key);
      throw error;
    }
  }

  async close(): Promise<void> {
    const graphs = await Promise.allSettled(this.#graphs.values());
    await Promise.all(
      graphs.map((graph) => (graph.status === 'fulfilled' ? graph.value.close() : undefined)),
    );
  }
}
