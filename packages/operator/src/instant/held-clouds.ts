import type { RobotClient } from '../client/robot-client.ts';
import type { RobotEvents } from '../client/robot-events.ts';
import type { Batch } from '../cloud/batch.ts';
import { captureMsOfStamp } from './capture-instant.ts';
import type { CloudHold } from './cloud-hold.ts';

/** Where clouds come from: a {@link RobotClient}, or an object with the same interface. */
export type CloudSource = Pick<
  RobotClient,
  'on' | 'release' | 'noteUploaded' | 'noteDrawn' | 'pointsAtMs'
> & {
  /** Latency tests: `wantsTime` says whether the display frame being drawn must be timed. */
  readonly latency: Pick<RobotClient['latency'], 'wantsTime'>;
};

/** Where clouds come from, and the clock on which they were captured. */
export type ClockedCloudSource = CloudSource & {
  /** Whose session knows the robot's clock. */
  readonly link: SessionClock;
};

/** What {@link HeldClouds} reads of a client's link. */
export interface SessionClock {
  /** The session, which compares its robot's clock with the page's. */
  readonly session: {
    /** The comparison. */
    readonly clock: Pick<RobotClient['link']['session']['clock'], 'offsetMs'>;
  };
}

/** A robot's clouds, some of them a little later: in step with the videos. */
export class HeldClouds implements CloudSource {
  /** Of the source. */
  readonly latency: CloudSource['latency'];
  readonly #source: ClockedCloudSource;
  readonly #hold: CloudHold;
  readonly #now: () => number;
  #session = 0;
  /** Called with each batch as it comes, before it is held; it must copy what it keeps. */
  onBatch: ((batch: Batch) => void) | null = null;

  /** @param now the clock of {@link advance}, such as `performance.now()` */
  constructor(source: ClockedCloudSource, hold: CloudHold, now: () => number) {
    this.latency = source.latency;
    this.#source = source;
    this.#hold = hold;
    this.#now = now;
    source.on('session', (session) => {
      this.#session = session;
      hold.clear();
    });
  }

  /** Of the source. */
  get pointsAtMs(): number {
    return this.#source.pointsAtMs;
  }

  /** Listens to the source; clouds come when they are no longer held. @returns ends it */
  on<Type extends keyof RobotEvents>(type: Type, listener: (event: RobotEvents[Type]) => void): () => void {
    if (type !== 'cloud' && !type.startsWith('cloud:')) return this.#source.on(type, listener);
    // The types cannot say that these events are batches.
    const take = listener as (batch: Batch) => void;
    return this.#source.on(type as 'cloud', (batch) => this.#take(batch, take));
  }

  /** Of the source. */
  release(batch: Batch): void {
    this.#source.release(batch);
  }

  /** Of the source. */
  noteUploaded(batch: Batch, packet: number): void {
    this.#source.noteUploaded(batch, packet);
  }

  /** Of the source. */
  noteDrawn(nowMs: number): void {
    this.#source.noteDrawn(nowMs);
  }

  /**
   * Passes clouds that have waited long enough. Call it for each display frame, after the videos and before the clouds.
   *
   * @param videoMs the newest capture instant of what is shown of the videos, robot's clock; `null` for none
   */
  advance(videoMs: number | null, nowMs: number): void {
    this.#hold.advance(videoMs, nowMs);
  }

  #take(batch: Batch, take: (batch: Batch) => void): void {
    this.onBatch?.(batch);
    const nowMs = this.#now();
    const { offsetMs } = this.#source.link.session.clock;
    // Without videos, nothing says what time it is, and there is nothing to wait for.
    if (offsetMs === null || batch.packets === 0) {
      take(batch);
      return;
    }
    const session = this.#session;
    this.#hold.add(captureMsOfStamp(batch.captureTimeUs(0), nowMs + offsetMs), nowMs, () => {
      if (session === this.#session) take(batch);
      else this.#source.release(batch);
    });
  }
}
