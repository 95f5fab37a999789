import type { Intervention } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { LimitedLines } from '../../ground/limited-lines.ts';

/** Logs and counts what bounds the robot's motion. A driver can bring it about without end, but not fill the log. */
export class InterventionReport {
  readonly #log: Logger;
  readonly #count: (reason: Intervention) => void;
  readonly #lines = new LimitedLines();

  constructor(log: Logger, count: (reason: Intervention) => void) {
    this.#log = log;
    this.#count = count;
  }

  begins(reason: Intervention, nowMs: number): void {
    this.#count(reason);
    const leftOut = this.#lines.take(nowMs);
    if (leftOut === null) return;
    this.#log.info({ reason, ...(leftOut === 0 ? {} : { unreported: leftOut }) }, 'motion is bounded');
  }
}
