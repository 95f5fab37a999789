/** One run of the program `farpoint-video`, from its start to its end. */
import { type ChildProcessWithoutNullStreams, spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { type LogLine, parseError, parseLogLine, parseState, type VideoState } from './process-messages.ts';
import { type VideoFailure, videoFailure } from './video-failure.ts';
import {
  type CodedPicture,
  type EncodedFrame,
  FROM_PROCESS,
  INTER_CODINGS,
  MessageParser,
  parseEncoded,
  type RawFrame,
  VideoWireError,
  type WireMessage,
  writeCodedHead,
  writeFrameHead,
} from './wire.ts';

/** From the friendly signal to the one that cannot be ignored. */
const KILL_AFTER_MS = 3000;
/** Coded pictures that wait for the process, bytes. It reads all that comes, so there are many only if it hangs. */
const MOST_WAITING_BYTES = 4 * 1024 * 1024;

export interface EncoderChildEvents {
  readonly onFrame: (frame: EncodedFrame) => void;
  readonly onState: (state: VideoState) => void;
  readonly onLog: (line: LogLine) => void;
  /** Once, unless it was closed. The process is gone by then. */
  readonly onEnd: (failure: VideoFailure) => void;
}

export class EncoderChild {
  readonly #child: ChildProcessWithoutNullStreams;
  readonly #events: EncoderChildEvents;
  readonly #parser = new MessageParser();
  readonly #gone: Promise<void>;
  #failure: VideoFailure | null = null;
  #closing = false;
  #kill: NodeJS.Timeout | null = null;
  #takingFrame = false;
  #lostCoded = false;

  constructor(program: string, env: NodeJS.ProcessEnv, events: EncoderChildEvents) {
    this.#events = events;
    const child = spawn(program, [], { env, stdio: ['pipe', 'pipe', 'pipe'] });
    this.#child = child;
    this.#gone = new Promise((resolve) => {
      // `close` comes after the last bytes of its output, and after `error` if it could not be started.
      child.once('close', (code, signal) => {
        resolve();
        this.#onGone(code, signal);
      });
    });
    child.once('error', (error) => {
      this.#failure ??= videoFailure('not-built', error.message);
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

  send(message: Uint8Array): void {
    if (!this.#closing && this.#child.stdin.writable) this.#child.stdin.write(message);
  }

  /** Returns false, without taking it, while the process still takes the picture before. */
  pushFrame(frame: RawFrame): boolean {
    const { stdin } = this.#child;
    if (this.#takingFrame || this.#closing || !stdin.writable) return false;
    this.#takingFrame = true;
    stdin.write(writeFrameHead(frame));
    stdin.write(frame.bytes, () => {
      this.#takingFrame = false;
    });
    return true;
  }

  /** Returns false, without taking it, while the process still takes too much of what came before. */
  pushCoded(picture: CodedPicture): boolean {
    const { stdin } = this.#child;
    const inter = INTER_CODINGS.has(picture.coding);
    // Where others need it, a picture is only left out if it must be.
    const room = inter ? stdin.writableLength < MOST_WAITING_BYTES : !this.#takingFrame;
    if (!room || this.#closing || !stdin.writable) {
      this.#lostCoded = true;
      return false;
    }
    this.#takingFrame = true;
    stdin.write(writeCodedHead(picture, this.#lostCoded));
    this.#lostCoded = false;
    stdin.write(picture.bytes, () => {
      this.#takingFrame = false;
    });
    return true;
  }

  /** Resolves when the process is gone. */
  close(): Promise<void> {
    this.#end();
    return this.#gone;
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
    try {
      this.#parser.push(chunk, (message) => this.#onMessage(message));
    } catch (error) {
      // What a receiver of events throws is not the process's fault.
      if (!(error instanceof VideoWireError)) throw error;
      this.#failure ??= videoFailure('bad-output', error.message);
      this.#end();
    }
  }

  #onMessage({ type, payload }: WireMessage): void {
    if (this.#closing) return;
    if (type === FROM_PROCESS.encoded) this.#events.onFrame(parseEncoded(payload));
    else if (type === FROM_PROCESS.state) this.#events.onState(parseState(payload));
    else {
      const { reason, said, detail } = parseError(payload);
      if (detail !== '') this.#events.onLog({ level: 'debug', msg: detail });
      this.#failure ??= videoFailure(reason, said);
    }
  }

  #onGone(code: number | null, signal: NodeJS.Signals | null): void {
    if (this.#kill !== null) clearTimeout(this.#kill);
    if (this.#closing && this.#failure === null) return;
    const how = signal === null ? `it ended with the code ${code}` : `it was ended by ${signal}`;
    this.#closing = true;
    this.#events.onEnd(this.#failure ?? videoFailure('process-lost', how));
  }
}
