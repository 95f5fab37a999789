/** The program `farpoint-sound`, started again when it ends. */
import {
  KeptChild,
  type LogLine,
  MediaChild,
  mediaEnvironment,
  REASON_OF_END,
  type Retry,
  type WireMessage,
  writeOpen,
} from '@farpoint/media-process';
import { ADDON_FILE } from './build.ts';
import { parseError, parseState } from './process-messages.ts';
import { type SoundFailure, type SoundRole, soundFailure } from './sound-failure.ts';
import { FROM_PROCESS, MessageParser, parseSound, type SoundPacket, writeConfigure } from './wire.ts';

export interface SoundProcessEvents {
  /** The bytes are the receiver's; nothing is written there any more. */
  readonly onPacket?: (packet: SoundPacket) => void;
  /** The device is being used. */
  readonly onStarted?: () => void;
  /** Each time it stops to work. If it is `retried`, the process starts again by itself. */
  readonly onFailure: (failure: SoundFailure) => void;
  readonly onLog?: (line: LogLine) => void;
}

export interface SoundProcessOptions extends SoundProcessEvents {
  readonly role: SoundRole;
  /** The text of the whole pipeline. */
  readonly pipeline: string;
  /** How long a microphone may give nothing, ms; 0: for ever. */
  readonly silenceMs: number;
  readonly bitsPerS: number;
  /** Waits before another start. */
  readonly retry?: Retry | undefined;
  readonly program?: string | undefined;
  readonly env?: NodeJS.ProcessEnv | undefined;
}

export class SoundProcess {
  readonly #options: SoundProcessOptions;
  readonly #open: Uint8Array;
  readonly #kept: KeptChild<MediaChild>;
  #bitsPerS: number;

  constructor(options: SoundProcessOptions) {
    this.#options = options;
    this.#bitsPerS = options.bitsPerS;
    this.#open = writeOpen([
      ['role', options.role],
      ['pipeline', options.pipeline],
      ['silence-ms', String(options.silenceMs)],
    ]);
    this.#kept = new KeptChild(() => this.#start(), options.retry);
    this.#kept.start();
  }

  /** Of the process; `undefined` while there is none. */
  get pid(): number | undefined {
    return this.#kept.child?.pid;
  }

  /** How often the process was started. */
  get starts(): number {
    return this.#kept.starts;
  }

  /** Bytes that the process has not taken yet; 0 while there is none. */
  get backlogBytes(): number {
    return this.#kept.child?.backlogBytes ?? 0;
  }

  configure(bitsPerS: number): void {
    this.#bitsPerS = bitsPerS;
    this.#kept.child?.send(writeConfigure(bitsPerS));
  }

  /** @returns whether there is a process that takes it */
  send(message: Uint8Array): boolean {
    const { child } = this.#kept;
    child?.send(message);
    return child?.writable ?? false;
  }

  /** Ends the process; resolves when it is gone. No event comes any more. */
  close(): Promise<void> {
    return this.#kept.close();
  }

  #start(): MediaChild {
    const { role, onLog, program = ADDON_FILE, env = mediaEnvironment(process.env) } = this.#options;
    let failure: SoundFailure | null = null;
    const child = new MediaChild(program, env, new MessageParser(), {
      onMessage: (message) => {
        failure = this.#onMessage(message) ?? failure;
      },
      onLog: (line) => onLog?.(line),
      onEnd: (end, detail) => {
        const ended = failure ?? soundFailure(role, REASON_OF_END[end], detail);
        if (this.#kept.onEnd(ended.retried)) this.#options.onFailure(ended);
      },
    });
    child.send(this.#open);
    child.send(writeConfigure(this.#bitsPerS));
    return child;
  }

  /** @returns why the process ends, if it says so */
  #onMessage({ type, payload }: WireMessage): SoundFailure | null {
    const { role, onPacket, onStarted, onLog } = this.#options;
    if (type === FROM_PROCESS.sound) onPacket?.(parseSound(payload));
    else if (type === FROM_PROCESS.state) {
      if (parseState(payload).state === 'started') onStarted?.();
    } else {
      const { reason, said, detail } = parseError(payload);
      if (detail !== '') onLog?.({ level: 'debug', msg: detail });
      return soundFailure(role, reason, said);
    }
    return null;
  }
}
