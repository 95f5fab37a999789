import { Backoff } from '@farpoint/timing';
import type { VideoEncoder as EncoderElement } from '@farpoint/video';
import { ProcessEncoder } from '../process-encoder.ts';
import type { VideoEncoder, VideoEncoderEvents, VideoLog } from '../video-encoder.ts';
import type { EncodedFormat } from '../video-plan.ts';
import type { Feed, FeedEvents, FeedTarget } from './feed.ts';

const RETRY = { firstMs: 500, mostMs: 10_000 };

/** Opens what feeds the target. What it throws is the camera's fault, and tried again. */
export type OpenFeed = (target: FeedTarget, events: FeedEvents) => Promise<Feed>;

/** A camera's encoder, and what feeds it. */
export class FedEncoder implements VideoEncoder {
  readonly #encoder: ProcessEncoder;
  readonly #openFeed: OpenFeed;
  readonly #events: VideoEncoderEvents;
  readonly #backoff = new Backoff({ ...RETRY, random: Math.random });
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
