import { type VideoEncoder as EncoderElement, VideoProcess, type VideoSourceOptions } from '@farpoint/video';
import type { VideoEncoder, VideoEncoderEvents, VideoLog } from './video-encoder.ts';
import type { EncodedFormat } from './video-plan.ts';

/** What is encoded, and by what. Plain data, so that it can be passed to a worker. */
export interface ProcessEncoderOptions {
  source: VideoSourceOptions;
  encoder: EncoderElement;
}

/** A camera's encoder as a process, with its faults as sentences and its drops counted over all its restarts. */
export class ProcessEncoder implements VideoEncoder {
  readonly process: VideoProcess;
  #dropped = 0;
  /** Of earlier processes: each counts from 0. */
  #droppedBefore = 0;
  #encoded = 0;
  #unreadable = 0;

  constructor(
    { source, encoder }: ProcessEncoderOptions,
    format: EncodedFormat,
    events: VideoEncoderEvents,
    log: VideoLog,
  ) {
    this.process = new VideoProcess({
      source,
      encoder,
      settings: settingsOf(format),
      onFrame: ({ bytes, key, captureMs: capturedAtMs, width, height }) => {
        events.onFault(null);
        events.onPicture({ bytes, key, capturedAtMs, width, height });
      },
      onState: (state) => {
        if (state.state === 'playing') {
          log.info({ video: state }, 'video plays');
          return;
        }
        const { dropped, undecoded, damaged, refused, encoded } = state;
        this.#dropped = dropped + undecoded + damaged + refused;
        const unreadable = damaged + refused;
        if (unreadable > this.#unreadable && encoded === this.#encoded)
          events.onFault('the camera’s pictures are damaged or of no known kind; check what it sends');
        this.#unreadable = unreadable;
        this.#encoded = encoded;
      },
      onFailure: ({ sentence, remedy, retried, reason }) => {
        log.debug({ reason, retried, remedy }, sentence);
        this.#droppedBefore += this.#dropped;
        this.#dropped = this.#encoded = this.#unreadable = 0;
        events.onFault(`${sentence}; ${remedy}`, reason);
      },
      onLog: ({ level, msg }) => log[level]({ from: 'farpoint-video' }, msg),
    });
  }

  get dropped(): number {
    return this.#droppedBefore + this.#dropped + this.process.notTaken;
  }

  configure(format: EncodedFormat): void {
    this.process.configure(settingsOf(format));
  }

  requestKeyFrame(): void {
    this.process.requestKeyFrame();
  }

  close(): Promise<void> {
    return this.process.close();
  }
}

function settingsOf({ width, height, framesPerSecond, bitsPerSecond, barcode }: EncodedFormat) {
  return {
    bitsPerS: bitsPerSecond,
    framesPerS: framesPerSecond,
    width,
    height,
    barcode: barcode ? ('monotonic' as const) : undefined,
  };
}
