/**
 * Releases the emergency stop for somebody at the robot. Operators of the reference system have no message for it, and
 * after a crash nobody else may be there. Motion then needs a hand that has let go, as after every release. Time is an
 * argument.
 */
import type { EstopState } from '@farpoint/protocol';
import type { DriveGuard, EstopReleaseRefusal } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { ReleaseRequest } from './release-request.ts';

/**
 * Between two looks for a request, ms. Chosen: who releases at the robot waits this long at most; a look
 * costs a call of the file system.
 */
const LOOK_MS = 250;

const words: Readonly<Record<EstopReleaseRefusal, string>> = {
  'not-lease-holder': 'nobody at the robot may release it',
  'not-latched': 'it is not latched',
  'held-at-robot': 'a stop at the robot holds it, which is released there',
  'newer-latch': 'it was latched again in the meantime',
  'not-supervisor': 'an operator has pressed STOP, which only a supervisor releases',
  'not-latcher': 'an operator who is there has pressed STOP, and releases it',
  'others-latched': 'operators who are there have pressed STOP, and release it',
};

export class LocalRelease {
  readonly #request: Pick<ReleaseRequest, 'take'>;
  readonly #guard: Pick<DriveGuard, 'estopState' | 'releaseEstop'>;
  readonly #log: Pick<Logger, 'warn'>;
  #nextMs = Number.NEGATIVE_INFINITY;
  /** The latest latch when nobody had asked yet. */
  #latch: EstopState['latch'];

  constructor(
    request: Pick<ReleaseRequest, 'take'>,
    guard: Pick<DriveGuard, 'estopState' | 'releaseEstop'>,
    log: Pick<Logger, 'warn'>,
  ) {
    this.#request = request;
    this.#guard = guard;
    this.#log = log;
    this.#latch = guard.estopState().latch;
  }

  /** Call this every 25 ms. @returns whether the emergency stop was released: apply the velocity, and tell everybody */
  look(nowMs: number): boolean {
    if (nowMs < this.#nextMs) return false;
    this.#nextMs = nowMs + LOOK_MS;
    const latch = this.#latch;
    this.#latch = this.#guard.estopState().latch;
    if (!this.#request.take()) return false;
    // Whoever asked cannot know of a STOP that was pressed since.
    const outcome = this.#guard.releaseEstop(null, false, latch);
    if (outcome.released) this.#log.warn('somebody at the robot has released the emergency stop');
    else
      this.#log.warn(
        { reason: outcome.reason },
        `somebody at the robot cannot release the emergency stop: ${words[outcome.reason]}`,
      );
    return outcome.released;
  }
}
