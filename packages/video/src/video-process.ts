/** The encoded pictures of one camera, from a process of its own that is started again when it ends. */
import { mediaEnvironment } from '@farpoint/media-process';
import { Backoff, MEDIA_RETRY, MEDIA_SUCCESS_MS } from '@farpoint/timing';
import { ADDON_FILE } from './build.ts';
import { EncoderChild } from './encoder-child.ts';
import { ENCODER_PROPERTIES, type VideoEncoder } from './encoders.ts';
import { KeyFrameLimit } from './key-frame-limit.ts';
import { LineLimit } from './line-limit.ts';
import { openMessage } from './open-message.ts';
import type { LogLine, VideoState } from './process-messages.ts';
import type { VideoFailure } from './video-failure.ts';
import { type VideoSettings, videoSettingsSchema } from './video-settings.ts';
import { type VideoSource, type VideoSourceOptions, videoSourceSchema } from './video-source.ts';
import {
  type CodedPicture,
  type EncodedFrame,
  MOST_CODED_BYTES,
  type RawFrame,
  rawFrameBytes,
  writeConfigure,
  writeKeyFrame,
} from './wire.ts';

/**
 * At most one key frame in this time, whoever asks for it, ms. Chosen: above the round trip after which a
 * page asks again; each costs some average pictures (docs/video.md). key-frame-limit.test.ts holds the limit.
 */
const KEY_FRAME_INTERVAL_MS = 300;
/**
 * Of the process's log, at most so many lines in this time, ms. Chosen: a fault is told whole, and a plugin
 * that complains of each picture fills no disk.
 */
const MOST_LINES = 40;
const LINES_MS = 10_000;

export interface VideoProcessOptions {
  readonly source: VideoSourceOptions;
  /** From `chooseEncoder`. */
  readonly encoder: VideoEncoder;
  readonly settings: VideoSettings;
  /** The bytes are the receiver's; nothing is written there any more. */
  readonly onFrame: (frame: EncodedFrame) => void;
  readonly onState?: (state: VideoState) => void;
  /** Each time no video comes any more. If it is `retried`, the process starts again by itself. */
  readonly onFailure: (failure: VideoFailure) => void;
  readonly onLog?: (line: LogLine) => void;
  /** Further properties of the encoder, `name=value`, separated by spaces. */
  readonly encoderProperties?: string;
  /** How long the source may give no picture, ms; 0: for ever. By default, what its kind needs. */
  readonly silenceMs?: number;
  /** Waits before another start. */
  readonly retry?: { readonly firstMs: number; readonly mostMs: number };
  /** Uniform in [0, 1). */
  readonly random?: () => number;
  readonly program?: string;
  readonly env?: NodeJS.ProcessEnv;
}

export class VideoProcess {
  readonly #options: VideoProcessOptions;
  readonly #source: VideoSource;
  readonly #open: Uint8Array;
  readonly #backoff: Backoff;
  readonly #keyFrames = new KeyFrameLimit(KEY_FRAME_INTERVAL_MS);
  readonly #lines = new LineLimit(MOST_LINES, LINES_MS);
  #settings: VideoSettings;
  #child: EncoderChild | null = null;
  #keyFrameTimer: NodeJS.Timeout | null = null;
  #retryTimer: NodeJS.Timeout | null = null;
  #firstFrameMs: number | null = null;
  #notTaken = 0;
  #starts = 0;
  #closed = false;

  /** @throws {z.ZodError} if the source or the settings are not valid; {RangeError} for the encoder's properties */
  constructor(options: VideoProcessOptions) {
    this.#options = options;
    this.#source = videoSourceSchema.parse(options.source);
    this.#settings = videoSettingsSchema.parse(options.settings);
    const extra = options.encoderProperties ?? '';
    if (!ENCODER_PROPERTIES.test(extra))
      throw new RangeError('the encoder’s properties must be name=value, separated by spaces');
    this.#open = openMessage(this.#source, options.encoder, extra, options.silenceMs);
    this.#backoff = new Backoff({ ...(options.retry ?? MEDIA_RETRY), random: options.random ?? Math.random });
    this.#start();
  }

  get settings(): VideoSettings {
    return this.#settings;
  }

  /** How often the process was started. */
  get starts(): number {
    return this.#starts;
  }

  /** Pictures that were pushed and not taken, because the one before was still under way. */
  get notTaken(): number {
    return this.#notTaken;
  }

  /** Of the process; `undefined` while there is none. */
  get pid(): number | undefined {
    return this.#child?.pid;
  }

  /**
   * Changes some of the settings; an `undefined` one is no wish any more. A new bit rate applies to the next picture. A
   * new size or rate, too, and that picture is a key frame.
   */
  configure(change: { [Name in keyof VideoSettings]?: VideoSettings[Name] | undefined }): void {
    this.#settings = videoSettingsSchema.parse({ ...this.#settings, ...change });
    this.#child?.send(writeConfigure(this.#settings));
  }

  /** Asks for a picture that can be decoded without any other. Requests that come fast are one. */
  requestKeyFrame(): void {
    const waitMs = this.#closed ? null : this.#keyFrames.request(performance.now());
    if (waitMs === null) return;
    if (waitMs === 0) {
      this.#child?.send(writeKeyFrame());
      return;
    }
    this.#keyFrameTimer = setTimeout(() => {
      this.#keyFrames.passed(performance.now());
      this.#child?.send(writeKeyFrame());
    }, waitMs);
  }

  /** Whether a raw picture that is pushed now would be taken. Once one is, the bytes of those before it are free. */
  get takes(): boolean {
    return this.#child?.takes ?? false;
  }

  /**
   * For a source of the kind `frames`. The bytes must stay as they are until they are taken, so each picture should
   * have a buffer of its own.
   *
   * @returns whether it is taken; if not, it is counted in `notTaken`
   * @throws {RangeError} if the number of bytes is not that of the shape
   */
  pushFrame(frame: RawFrame): boolean {
    if (frame.bytes.length !== rawFrameBytes(frame))
      throw new RangeError(`the picture has ${frame.bytes.length} bytes instead of ${rawFrameBytes(frame)}`);
    const taken = this.#child?.pushFrame(frame) ?? false;
    if (!taken) this.#notTaken++;
    return taken;
  }

  /**
   * For a source of the kind `frames`: a picture that the process decodes. One that is damaged is left out and counted
   * (`VideoStats`). H.264 and VP8 begin, and go on after a gap, with a key frame. For the bytes, the rule of
   * `pushFrame` applies.
   *
   * @returns whether it is taken; if not, it is counted in `notTaken`
   * @throws {RangeError} if there are no bytes, or more than 32 MiB
   */
  pushCoded(picture: CodedPicture): boolean {
    const { length } = picture.bytes;
    if (length === 0 || length > MOST_CODED_BYTES)
      throw new RangeError(`the coded picture has ${length} bytes instead of 1 to ${MOST_CODED_BYTES}`);
    const taken = this.#child?.pushCoded(picture) ?? false;
    if (!taken) this.#notTaken++;
    return taken;
  }

  /** Ends the process; resolves when it is gone. No event comes any more. */
  async close(): Promise<void> {
    this.#closed = true;
    if (this.#retryTimer !== null) clearTimeout(this.#retryTimer);
    if (this.#keyFrameTimer !== null) clearTimeout(this.#keyFrameTimer);
    await this.#child?.close();
  }

  #start(): void {
    const {
      onFrame,
      onState,
      onLog,
      program = ADDON_FILE,
      env = mediaEnvironment(process.env),
    } = this.#options;
    this.#starts++;
    this.#firstFrameMs = null;
    this.#child = new EncoderChild(program, env, {
      onFrame: (frame) => {
        this.#firstFrameMs ??= frame.captureMs;
        if (frame.captureMs - this.#firstFrameMs > MEDIA_SUCCESS_MS) this.#backoff.reset();
        onFrame(frame);
      },
      onState: (state) => onState?.(state),
      onLog: (line) => {
        const leftOut = this.#lines.admit(performance.now());
        if (leftOut === null) return;
        if (leftOut > 0) onLog?.({ level: 'warn', msg: `${leftOut} lines were left out` });
        onLog?.(line);
      },
      onEnd: (failure) => this.#onEnd(failure),
    });
    this.#child.send(this.#open);
    this.#child.send(writeConfigure(this.#settings));
  }

  #onEnd(failure: VideoFailure): void {
    this.#child = null;
    if (this.#closed) return;
    if (failure.retried) this.#retryTimer = setTimeout(() => this.#start(), this.#backoff.nextMs());
    this.#options.onFailure(failure);
  }
}
