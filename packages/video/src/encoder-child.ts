/** One run of the program `farpoint-video`, from its start to its end. */
import { type ChildEnd, MediaChild, type WireMessage } from '@farpoint/media-process';
import { type LogLine, parseError, parseState, type VideoState } from './process-messages.ts';
import { type VideoFailure, type VideoFailureReason, videoFailure } from './video-failure.ts';
import {
  type EncodedFrame,
  FROM_PROCESS,
  MessageParser,
  parseEncoded,
  type RawFrame,
  writeFrameHead,
} from './wire.ts';

export interface EncoderChildEvents {
  readonly onFrame: (frame: EncodedFrame) => void;
  readonly onState: (state: VideoState) => void;
  readonly onLog: (line: LogLine) => void;
  /** Once, unless it was closed. The process is gone by then. */
  readonly onEnd: (failure: VideoFailure) => void;
}

const REASON_OF_END: Record<ChildEnd, VideoFailureReason> = {
  'not-started': 'not-built',
  'bad-output': 'bad-output',
  ended: 'process-lost',
};

export class EncoderChild {
  readonly #child: MediaChild;
  readonly #events: EncoderChildEvents;
  #failure: VideoFailure | null = null;
  #takingFrame = false;

  constructor(program: string, env: NodeJS.ProcessEnv, events: EncoderChildEvents) {
    this.#events = events;
    this.#child = new MediaChild(program, env, new MessageParser(), {
      onMessage: (message) => this.#onMessage(message),
      onLog: events.onLog,
      onEnd: (end, detail) => events.onEnd(this.#failure ?? videoFailure(REASON_OF_END[end], detail)),
    });
  }

  /** Of the process; `undefined` if it could not be started. */
  get pid(): number | undefined {
    return this.#child.pid;
  }

  send(message: Uint8Array): void {
    this.#child.send(message);
  }

  /** Returns false, without taking it, while the process still takes the picture before. */
  pushFrame(frame: RawFrame): boolean {
    if (this.#takingFrame || !this.#child.writable) return false;
    this.#takingFrame = true;
    this.#child.send(writeFrameHead(frame));
    this.#child.send(frame.bytes, () => {
      this.#takingFrame = false;
    });
    return true;
  }

  /** Resolves when the process is gone. */
  close(): Promise<void> {
    return this.#child.close();
  }

  #onMessage({ type, payload }: WireMessage): void {
    if (type === FROM_PROCESS.encoded) this.#events.onFrame(parseEncoded(payload));
    else if (type === FROM_PROCESS.state) this.#events.onState(parseState(payload));
    else {
      const { reason, said, detail } = parseError(payload);
      if (detail !== '') this.#events.onLog({ level: 'debug', msg: detail });
      this.#failure ??= videoFailure(reason, said);
    }
  }
}
