/** One run of the program `farpoint-video`, from its start to its end. */
import { MediaChild, REASON_OF_END, type WireMessage } from '@farpoint/media-process';
import { EncoderProgress } from './encoder-progress.ts';
import { type LogLine, parseError, parseState, type VideoState } from './process-messages.ts';
import { type VideoFailure, videoFailure } from './video-failure.ts';
import {
  type CodedPicture,
  type EncodedFrame,
  FROM_PROCESS,
  INTER_CODINGS,
  MessageParser,
  parseEncoded,
  type RawFrame,
  writeCodedHead,
  writeFrameHead,
} from './wire.ts';

/**
 * Coded pictures that wait for the process, bytes. It reads all that comes, so there are many only if it
 * hangs. Chosen: above a few of the largest coded pictures.
 */
const MOST_WAITING_BYTES = 4 * 1024 * 1024;

export interface EncoderChildEvents {
  readonly onFrame: (frame: EncodedFrame) => void;
  readonly onState: (state: VideoState) => void;
  readonly onLog: (line: LogLine) => void;
  /** Once, unless it was closed. The process is gone by then. */
  readonly onEnd: (failure: VideoFailure) => void;
}

export class EncoderChild {
  readonly #child: MediaChild;
  readonly #events: EncoderChildEvents;
  readonly #progress = new EncoderProgress();
  #failure: VideoFailure | null = null;
  #takingFrame = false;
  #lostCoded = false;

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

  /** Whether a raw picture would be taken now. */
  get takes(): boolean {
    return !this.#takingFrame && this.#child.writable;
  }

  /** Returns false, without taking it, while the process still takes the picture before. */
  pushFrame(frame: RawFrame): boolean {
    if (!this.takes) return false;
    this.#takingFrame = true;
    this.#child.send(writeFrameHead(frame));
    this.#child.send(frame.bytes, () => {
      this.#takingFrame = false;
    });
    return true;
  }

  /** Returns false, without taking it, while the process still takes too much of what came before. */
  pushCoded(picture: CodedPicture): boolean {
    const inter = INTER_CODINGS.has(picture.coding);
    // Where others need it, a picture is only left out if it must be.
    const room = inter ? this.#child.backlogBytes < MOST_WAITING_BYTES : !this.#takingFrame;
    if (!room || !this.#child.writable) {
      this.#lostCoded = true;
      return false;
    }
    this.#takingFrame = true;
    this.#child.send(writeCodedHead(picture, this.#lostCoded));
    this.#lostCoded = false;
    this.#child.send(picture.bytes, () => {
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
    else if (type === FROM_PROCESS.state) this.#onState(parseState(payload));
    else {
      const { reason, said, detail } = parseError(payload);
      if (detail !== '') this.#events.onLog({ level: 'debug', msg: detail });
      this.#failure ??= videoFailure(reason, said);
    }
  }

  #onState(state: VideoState): void {
    this.#events.onState(state);
    if (state.state !== 'stats') return;
    const stuck = this.#progress.onStats(state);
    if (stuck === null) return;
    this.#failure ??= videoFailure('encoder-failed', stuck);
    this.#child.giveUp(stuck);
  }
}
