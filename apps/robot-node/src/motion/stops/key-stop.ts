import { RobotStopSignal, type RobotStopState } from '@farpoint/safety';
import type { StopSource } from './stop-source.ts';

const RELEASE = 'release';
const CTRL_C = 0x03;
const LINE_FEED = 0x0a;
const RETURN = 0x0d;

export type KeyWord = 'stop' | 'release' | 'interrupt';

/** Every key stops, also those that spell `release`; the Enter that completes it releases. Ctrl+C ends the program. */
export class KeyWords {
  /** The last keys, as many as the word has. */
  #typed = '';

  /** @param bytes as the console sends them at once @returns what each key says, in order */
  take(bytes: Uint8Array): KeyWord[] {
    const words: KeyWord[] = [];
    let last = 0;
    for (const byte of bytes) {
      // One Enter, if it comes as two bytes. Later, a line feed is a key of its own.
      const isRepeat = byte === LINE_FEED && last === RETURN;
      last = byte;
      if (!isRepeat) words.push(this.#key(byte));
    }
    return words;
  }

  #key(byte: number): KeyWord {
    const typed = this.#typed;
    this.#typed = '';
    if (byte === CTRL_C) return 'interrupt';
    if (byte === RETURN || byte === LINE_FEED) return typed === RELEASE ? 'release' : 'stop';
    this.#typed = `${typed}${String.fromCharCode(byte)}`.slice(-RELEASE.length);
    // Whoever begins the word may as well have hit the key in alarm.
    return 'stop';
  }
}

/** The robot's console: a terminal, or a pipe. */
export interface Console {
  readonly isTTY?: boolean;
  setRawMode?(raw: boolean): unknown;
  on(event: 'data', listener: (data: Buffer) => void): unknown;
  on(event: 'end' | 'close', listener: () => void): unknown;
  on(event: 'error', listener: (error: Error) => void): unknown;
  off(event: string, listener: (data: Buffer) => void): unknown;
  pause(): unknown;
}

/** A key on the robot's console stops; `release` and Enter release. A console that is gone stops, too. */
export class KeyStop implements StopSource {
  readonly stop = 'key';
  readonly name = 'console';
  onChange: (() => void) | null = null;
  readonly #console: Console;
  readonly #interrupt: () => void;
  readonly #signal: RobotStopSignal;
  readonly #words = new KeyWords();
  #fault: string | null = null;
  #nowMs = 0;
  readonly #onData = (data: Buffer) => this.#take(data);
  readonly #onEnd = () => this.#lose('the console is gone');
  readonly #onError = (error: Error) => this.#lose(`the console cannot be read: ${error.message}`);

  /**
   * @param console from which keys are read, one by one if it is a terminal
   * @param pressed whether it was pressed when the robot last ran
   * @param interrupt what Ctrl+C does: a terminal that gives single keys raises no signal itself
   */
  constructor(console: Console, pressed: boolean, interrupt: () => void) {
    this.#console = console;
    this.#interrupt = interrupt;
    this.#signal = new RobotStopSignal({ silentMs: null, steadyMs: 0, pressed });
    // A console that can be read says go as long as nobody presses a key.
    if (!pressed) this.#signal.hear(false, 0);
    console.on('data', this.#onData);
    console.on('end', this.#onEnd);
    console.on('close', this.#onEnd);
    console.on('error', this.#onError);
    if (console.isTTY === true) console.setRawMode?.(true);
  }

  get fault(): string | null {
    return this.#fault;
  }

  look(nowMs: number): RobotStopState {
    this.#nowMs = nowMs;
    return this.#signal.state(nowMs);
  }

  close(): void {
    const { isTTY } = this.#console;
    for (const [event, listener] of [
      ['data', this.#onData],
      ['end', this.#onEnd],
      ['close', this.#onEnd],
    ] as const)
      this.#console.off(event, listener);
    if (isTTY === true) this.#console.setRawMode?.(false);
    this.#console.pause();
  }

  #take(data: Buffer): void {
    for (const word of this.#words.take(data)) {
      if (word === 'interrupt') this.#interrupt();
      else this.#signal.hear(word === 'stop', this.#nowMs);
      // Each word by itself: a stop among others is not missed.
      this.onChange?.();
    }
  }

  #lose(fault: string): void {
    this.#fault = fault;
    this.#signal.lose();
    this.onChange?.();
  }
}
