import type { CloudSource } from '@farpoint/cloud-view';
import { type Batch, captureMsOfStamp, type RobotEvents, type RobotWatcher } from '@farpoint/operator';
import type { CloudHold } from './cloud-hold.ts';

/** A watcher's clouds, some of them a little later: in step with the videos. */
export class HeldClouds implements CloudSource {
  readonly latency = { wantsTime: false };
  readonly #watcher: RobotWatcher;
  readonly #hold: CloudHold | null;
  readonly #now: () => number;
  #session = 0;

  /** @param hold `null`: each cloud is drawn as it comes */
  constructor(watcher: RobotWatcher, hold: CloudHold | null, now: () => number) {
    this.#watcher = watcher;
    this.#hold = hold;
    this.#now = now;
    watcher.on('session', (session) => {
      this.#session = session;
      hold?.clear();
    });
  }

  get pointsAtMs(): number {
    return this.#watcher.pointsAtMs;
  }

  on<Type extends keyof RobotEvents>(type: Type, listener: (event: RobotEvents[Type]) => void): () => void {
    const hold = this.#hold;
    if (hold === null || (type !== 'cloud' && !type.startsWith('cloud:')))
      return this.#watcher.on(type, listener);
    // The types cannot say that these events are batches.
    const take = listener as (batch: Batch) => void;
    return this.#watcher.on(type as 'cloud', (batch) => this.#take(hold, batch, take));
  }

  release(batch: Batch): void {
    this.#watcher.release(batch);
  }

  noteUploaded(): void {}
  noteDrawn(): void {}

  /** Call this for each display frame, after the videos. */
  tick(shownMs: number | null, nowMs: number): void {
    this.#hold?.tick(shownMs, nowMs);
  }

  #take(hold: CloudHold, batch: Batch, take: (batch: Batch) => void): void {
    const nowMs = this.#now();
    const { offsetMs } = this.#watcher.link.session.clock;
    // Without videos, nothing says what time it is, and there is nothing to wait for.
    if (offsetMs === null || batch.packets === 0) {
      take(batch);
      return;
    }
    const session = this.#session;
    hold.add(captureMsOfStamp(batch.captureTimeUs(0), nowMs + offsetMs), nowMs, () => {
      if (session === this.#session) take(batch);
      else this.#watcher.release(batch);
    });
  }
}
