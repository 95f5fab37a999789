import { type GpioLine, type GpioLineAt, openGpioLine } from '@farpoint/gpio';
import { RobotStopSignal, type RobotStopState } from '@farpoint/safety';
import { STEADY_MS, type StopSource } from './stop-source.ts';

/** Between two attempts to request the line, ms. */
const RETRY_MS = 500;
/** A line is read at every look. If this thread hangs for longer, what was read before no longer counts, ms. */
const SILENT_MS = 500;

/** A GPIO line: active stops, and so does a line that cannot be read. */
export class GpioStop implements StopSource {
  readonly stop = 'gpio';
  readonly name: string;
  onChange: (() => void) | null = null;
  readonly #at: GpioLineAt;
  readonly #signal = new RobotStopSignal({ silentMs: SILENT_MS, steadyMs: STEADY_MS });
  #line: GpioLine | null = null;
  #triedMs = Number.NEGATIVE_INFINITY;
  #fault: string | null = null;

  constructor(at: GpioLineAt) {
    this.#at = at;
    this.name = `${at.chip} line ${at.line}`;
  }

  get fault(): string | null {
    return this.#fault;
  }

  look(nowMs: number): RobotStopState {
    try {
      if (this.#line === null && nowMs - this.#triedMs >= RETRY_MS) {
        this.#triedMs = nowMs;
        this.#line = openGpioLine(this.#at);
        this.#fault = null;
      }
      if (this.#line !== null) this.#signal.hear(this.#line.isActive(), nowMs);
    } catch (error) {
      this.close();
      this.#fault = (error as Error).message;
      this.#signal.lose();
    }
    return this.#signal.state(nowMs);
  }

  close(): void {
    this.#line?.close();
    this.#line = null;
  }
}
