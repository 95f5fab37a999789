/** Tells the robot which sensors' clouds are painted by videos: at each change, and every second while there are any. */
import type { CloudPaint } from '@farpoint/cloud-view';
import { PaintClaim } from './paint-claim.ts';

/** Well below the time for which a robot goes by it (`PAINTED_HINT_MS`). */
const REPEAT_MS = 1000;

/** What draws a sensor's cloud. */
export interface PaintedCloud {
  /** Whether videos can paint it at all. */
  readonly possible: boolean;
  readonly frames: CloudPaint['frames'];
}

export class PaintedHint {
  readonly #send: (sensors: readonly number[]) => void;
  /** By sensor number, as is {@link #counted}. */
  readonly #claims: PaintClaim[] = [];
  readonly #counted: { followed: number; painted: number }[] = [];
  #said: readonly number[] = [];
  #saidMs = Number.NEGATIVE_INFINITY;

  constructor(send: (sensors: readonly number[]) => void) {
    this.#send = send;
  }

  /** By sensor number. */
  get sensors(): readonly number[] {
    return this.#said;
  }

  /** Another session begins, whose robot has been told nothing. */
  clear(): void {
    this.#claims.length = 0;
    this.#said = [];
  }

  /** Call this at least every 50 ms. @param clouds by sensor number */
  tick(clouds: readonly PaintedCloud[], nowMs: number): void {
    const sensors: number[] = [];
    for (const [sensor, { possible, frames }] of clouds.entries()) {
      this.#claims[sensor] ??= new PaintClaim();
      const claim = this.#claims[sensor];
      const { followed, painted } = this.#counted[sensor] ?? frames;
      for (let n = painted; n < frames.painted; n++) claim.add(true, nowMs);
      const plain = frames.followed - followed - (frames.painted - painted);
      for (let n = 0; n < plain; n++) claim.add(false, nowMs);
      this.#counted[sensor] = { ...frames };
      claim.tick(possible, nowMs);
      if (claim.claimed) sensors.push(sensor);
    }
    const same = sensors.join() === this.#said.join();
    if (same && (sensors.length === 0 || nowMs - this.#saidMs < REPEAT_MS)) return;
    this.#said = sensors;
    this.#saidMs = nowMs;
    this.#send(sensors);
  }
}
