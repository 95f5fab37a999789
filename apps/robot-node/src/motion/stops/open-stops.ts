import { type GpioLine, type GpioLineAt, openGpioLine } from '@farpoint/gpio';
import type { RobotStop } from '@farpoint/protocol';
import { RobotStopSignal, type RobotStopState } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { StopBlock, type TrustedOwner } from '@farpoint/shared-memory';
import { KeyStop } from './key-stop.ts';
import { STEADY_MS, type StopSource } from './stop-source.ts';
import { TopicStop, type TopicStopOptions } from './topic-stop.ts';

/**
 * Between two attempts to open the file, ms. Chosen: a producer that starts is found within a tenth of a
 * second, for ten cheap calls a second.
 */
const FILE_RETRY_MS = 100;

export interface ShmStopOptions {
  path: string;
  owner?: TrustedOwner | undefined;
  /** A counter that stands still for longer stops, ms. */
  silentMs: number;
}

/** A stop byte in shared memory, beside a counter that another program keeps running. */
class ShmStop implements StopSource {
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
      if (nowMs - this.#triedMs < FILE_RETRY_MS) return;
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

/**
 * Between two attempts to request the line, ms. Chosen: seldomer than a file, because another program may
 * hold the line for as long as it runs.
 */
const LINE_RETRY_MS = 500;
/**
 * A line is read at every look. If this thread hangs for longer, what was read before no longer counts, ms.
 * Chosen: as long as other stops may be silent by default (`robot.stops.silenceMs`).
 */
const SILENT_MS = 500;

/** A GPIO line: active stops, and so does a line that cannot be read. */
class GpioStop implements StopSource {
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
      if (this.#line === null && nowMs - this.#triedMs >= LINE_RETRY_MS) {
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

/** The stops at the robot that are configured. */
export interface RobotStopsOptions {
  topic?: TopicStopOptions | undefined;
  shm?: ShmStopOptions | undefined;
  gpio?: GpioLineAt | undefined;
  /** A key on the console. */
  key: boolean;
}

export function isConfigured(options: RobotStopsOptions, stop: RobotStop): boolean {
  return stop === 'key' ? options.key : options[stop] !== undefined;
}

/** @param remembered the stops that held the emergency stop when the robot last ran */
export function openStops(
  { topic, shm, gpio, key }: RobotStopsOptions,
  remembered: readonly RobotStop[],
  log: Logger,
): StopSource[] {
  const sources: StopSource[] = [];
  if (topic !== undefined) sources.push(new TopicStop(topic, log));
  if (shm !== undefined) sources.push(new ShmStop(shm));
  if (gpio !== undefined) sources.push(new GpioStop(gpio));
  if (key) {
    const interrupt = () => process.kill(process.pid, 'SIGINT');
    sources.push(new KeyStop(process.stdin, remembered.includes('key'), interrupt));
    log.info('every key on this console stops the robot; `release` and Enter release it');
  }
  return sources;
}
