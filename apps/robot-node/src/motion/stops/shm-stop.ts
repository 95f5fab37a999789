import { RobotStopSignal, type RobotStopState } from '@farpoint/safety';
import { StopBlock, type TrustedOwner } from '@farpoint/shared-memory';
import { STEADY_MS, type StopSource } from './stop-source.ts';

/** Between two attempts to open the file, ms. */
const RETRY_MS = 100;

export interface ShmStopOptions {
  path: string;
  owner?: TrustedOwner | undefined;
  /** A counter that stands still for longer stops, ms. */
  silentMs: number;
}

/** A stop byte in shared memory, beside a counter that another program keeps running. */
export class ShmStop implements StopSource {
  readonly stop = 'shm';
  readonly name: string;
  onChange: (() => void) | null = null;
  readonly #options: ShmStopOptions;
  readonly #signal: RobotStopSignal;
  #block: StopBlock | null = null;
  #counter: number | null = null;
  #triedMs = Number.NEGATIVE_INFINITY;
  #fault: string | null = null;

  constructor(options: ShmStopOptions) {
    this.#options = options;
    this.name = options.path;
    this.#signal = new RobotStopSignal({ silentMs: options.silentMs, steadyMs: STEADY_MS });
  }

  get fault(): string | null {
    return this.#fault;
  }

  look(nowMs: number): RobotStopState {
    try {
      this.#read(nowMs);
    } catch (error) {
      this.#lose((error as Error).message);
    }
    return this.#signal.state(nowMs);
  }

  close(): void {
    this.#block?.close();
    this.#block = null;
  }

  #read(nowMs: number): void {
    if (this.#block !== null && !this.#block.current) this.#lose(`${this.name} was removed or replaced`);
    if (this.#block === null) {
      if (nowMs - this.#triedMs < RETRY_MS) return;
      this.#triedMs = nowMs;
      this.#block = StopBlock.open(this.#options.path, this.#options.owner);
      this.#fault = null;
    }
    const { counter, stop } = this.#block.read();
    // The first value is no sign of life, but a stop counts at once.
    const lives = this.#counter !== null && counter !== this.#counter;
    this.#counter = counter;
    if (stop || lives) this.#signal.hear(stop, nowMs);
  }

  #lose(fault: string): void {
    this.close();
    this.#counter = null;
    this.#fault = fault;
    this.#signal.lose();
  }
}
