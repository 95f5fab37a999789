import type { CloudSource } from '@farpoint/cloud-view';
import { type Batch, captureMsOfStamp, type RobotEvents } from '@farpoint/operator';
import type { CloudHold } from './cloud-hold.ts';

/** Where clouds come from, and the clock on which they were captured. */
export interface ClockedCloudSource extends CloudSource {
  readonly link: { readonly session: { readonly clock: { readonly offsetMs: number | null } } };
}

/** A robot's clouds, some of them a little later: in step with the videos. */
export class HeldClouds implements CloudSource {
  readonly latency: CloudSource['latency'];
  readonly #source: ClockedCloudSource;
  readonly #hold: CloudHold;
  readonly #now: () => number;
  #session = 0;
  /** Called with each batch as it comes, before it is held; it must copy what it keeps. */
  onBatch: ((batch: Batch) => void) | null = null;

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

  get pointsAtMs(): number {
    return this.#source.pointsAtMs;
  }

  on<Type extends keyof RobotEvents>(type: Type, listener: (event: RobotEvents[Type]) => void): () => void {
    if (type !== 'cloud' && !type.startsWith('cloud:')) return this.#source.on(type, listener);
    // The types cannot say that these events are batches.
    const take = listener as (batch: Batch) => void;
    return this.#source.on(type as 'cloud', (batch) => this.#take(batch, take));
  }

  release(batch: Batch): void {
    this.#source.release(batch);
  }

  noteUploaded(batch: Batch, packet: number): void {
    this.#source.noteUploaded(batch, packet);
  }

  noteDrawn(nowMs: number): void {
    this.#source.noteDrawn(nowMs);
  }

  /**
   * Call this for each display frame, after the videos and before the clouds.
   *
   * @param videoMs the newest capture instant of what is shown of the videos, robot's clock; `null` for none
   */
  tick(videoMs: number | null, nowMs: number): void {
    this.#hold.tick(videoMs, nowMs);
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
