/** One run of a media program, from its start to its end. */
import { type ChildProcessWithoutNullStreams, spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { Heartbeat, MEDIA_SIGNS_OF_LIFE } from '@farpoint/timing';
import { WireError } from './wire-error.ts';
import { type LogLine, parseLogLine } from './wire-json.ts';
import type { WireMessage, WireMessageParser } from './wire-messages.ts';

/** From the friendly signal to the one that cannot be ignored. */
const KILL_AFTER_MS = 3000;

/** How a program ended that told no reason. */
export type ChildEnd =
  | 'not-started' // it is missing, or cannot be run
  | 'bad-output' // it sent what makes no sense
  | 'hung' // it said nothing any more, or did nothing, and was killed
  | 'ended'; // it ended, crashed or was killed

/** The reason of a failure for each of these ends. */
export const REASON_OF_END = {
  'not-started': 'not-built',
  'bad-output': 'bad-output',
  hung: 'process-hung',
  ended: 'process-lost',
} as const satisfies Record<ChildEnd, string>;

export interface MediaChildEvents {
  /** @throws {WireError} if the message is not valid: the program is ended */
  readonly onMessage: (message: WireMessage) => void;
  readonly onLog: (line: LogLine) => void;
  /** Once, unless it was closed. The process is gone by then. */
  readonly onEnd: (end: ChildEnd, detail: string) => void;
}

export class MediaChild {
  readonly #child: ChildProcessWithoutNullStreams;
  readonly #events: MediaChildEvents;
  readonly #parser: WireMessageParser;
  readonly #gone: Promise<void>;
  readonly #heartbeat = new Heartbeat(MEDIA_SIGNS_OF_LIFE, performance.now());
  readonly #checking: NodeJS.Timeout;
  #failed: { end: ChildEnd; detail: string } | null = null;
  #closing = false;
  #kill: NodeJS.Timeout | null = null;

  constructor(program: string, env: NodeJS.ProcessEnv, parser: WireMessageParser, events: MediaChildEvents) {
    this.#events = events;
    this.#parser = parser;
    const child = spawn(program, [], { env, stdio: ['pipe', 'pipe', 'pipe'] });
    this.#child = child;
    this.#checking = setInterval(() => this.#checkLife(), MEDIA_SIGNS_OF_LIFE.checkMs).unref();
    this.#gone = new Promise((resolve) => {
      // `close` comes after the last bytes of its output, and after `error` if it could not be started.
      child.once('close', (code, signal) => {
        resolve();
        this.#onGone(code, signal);
      });
    });
    child.once('error', (error) => {
      this.#failed ??= { end: 'not-started', detail: error.message };
    });
    // What is written to a process that has just ended is lost; its end is reported by itself.
    child.stdin.on('error', () => undefined);
    child.stdout.on('data', (chunk: Buffer) => this.#onData(chunk));
    createInterface({ input: child.stderr }).on('line', (line) => events.onLog(parseLogLine(line)));
  }

  /** Of the process; `undefined` if it could not be started. */
  get pid(): number | undefined {
    return this.#child.pid;
  }

  /** Whether it can be sent messages. */
  get writable(): boolean {
    return !this.#closing && this.#child.stdin.writable;
  }

  /** Bytes that it has not taken yet. */
  get backlogBytes(): number {
    return this.#child.stdin.writableLength;
  }

  /** @param onTaken called when the bytes have been handed over */
  send(bytes: Uint8Array, onTaken?: () => void): void {
    if (this.writable) this.#child.stdin.write(bytes, onTaken);
  }

  /** Resolves when the process is gone. */
  close(): Promise<void> {
    this.#end();
    return this.#gone;
  }

  /** It hangs: kills it at once, and reports its end as `hung`. @param detail how that shows */
  giveUp(detail: string): void {
    if (this.#closing) return;
    this.#closing = true;
    this.#failed ??= { end: 'hung', detail };
    this.#child.stdin.destroy();
    // One that hangs does not react to a friendly signal.
    this.#child.kill('SIGKILL');
  }

  #checkLife(): void {
    if (!this.#heartbeat.isLost(performance.now())) return;
    this.giveUp(`it has said nothing for ${Math.round(this.#heartbeat.silentMs / 1000)} s`);
  }

  #end(): void {
    if (this.#closing) return;
    this.#closing = true;
    this.#child.stdin.destroy();
    this.#child.kill('SIGTERM');
    this.#kill = setTimeout(() => this.#child.kill('SIGKILL'), KILL_AFTER_MS);
  }

  #onData(chunk: Uint8Array): void {
    if (this.#closing) return;
    this.#heartbeat.beat();
    try {
      this.#parser.push(chunk, (message) => {
        if (!this.#closing) this.#events.onMessage(message);
      });
    } catch (error) {
      // What a receiver of events throws is not the process's fault.
      if (!(error instanceof WireError)) throw error;
      this.#failed ??= { end: 'bad-output', detail: error.message };
      this.#end();
    }
  }

  #onGone(code: number | null, signal: NodeJS.Signals | null): void {
    if (this.#kill !== null) clearTimeout(this.#kill);
    clearInterval(this.#checking);
    if (this.#closing && this.#failed === null) return;
    const how = signal === null ? `it ended with the code ${code}` : `it was ended by ${signal}`;
    this.#closing = true;
    const { end, detail } = this.#failed ?? { end: 'ended', detail: how };
    this.#events.onEnd(end, detail);
  }
}
