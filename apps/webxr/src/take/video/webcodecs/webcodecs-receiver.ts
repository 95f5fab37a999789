/** Receives videos by WebCodecs: a worker takes each frame as it was sent, and decodes it. */
import type { OpenReader, ReaderEvents } from '../readers/open-reader.ts';
import type { FromVideoWorker, ToVideoWorker, VideoTransformOptions } from './worker-messages.ts';

/** Whether this browser has everything that it takes. */
export function hasWebCodecs(): boolean {
  return (
    typeof RTCRtpScriptTransform !== 'undefined' &&
    typeof VideoDecoder !== 'undefined' &&
    typeof EncodedVideoChunk !== 'undefined'
  );
}

interface OpenVideo {
  readonly events: ReaderEvents;
  undecoded: Readonly<Record<string, number>>;
}

export class WebCodecsReceiver {
  #worker: Worker | null = null;
  /** Numbers of the receivers, by which the worker knows them. */
  readonly #receivers = new WeakMap<RTCRtpReceiver, number>();
  readonly #videos = new Map<number, OpenVideo>();
  #made = 0;

  /** Call it as soon as the browser has made the receiver: later it takes no transform. */
  readonly adopt = (receiver: RTCRtpReceiver): void => {
    const number = ++this.#made;
    const options: VideoTransformOptions = { receiver: number };
    this.#receivers.set(receiver, number);
    receiver.transform = new RTCRtpScriptTransform(this.#started(), options);
  };

  readonly open: OpenReader = (source, events) => {
    const receiver = this.#receivers.get(source.receiver);
    if (receiver === undefined) throw new Error('a video whose receiver was not adopted');
    const video: OpenVideo = { events, undecoded: {} };
    this.#videos.set(receiver, video);
    this.#tell({ receiver, codec: source.codec });
    return {
      useCodec: (codec) => {
        if (this.#videos.get(receiver) === video) this.#tell({ receiver, codec });
      },
      close: () => {
        if (this.#videos.get(receiver) !== video) return;
        this.#videos.delete(receiver);
        this.#tell({ receiver, codec: null });
      },
      get undecoded() {
        return video.undecoded;
      },
    };
  };

  #tell(message: ToVideoWorker): void {
    this.#started().postMessage(message);
  }

  #started(): Worker {
    if (this.#worker === null) {
      const worker = new Worker(new URL('./video-worker.ts', import.meta.url), { type: 'module' });
      worker.onmessage = ({ data }: MessageEvent<FromVideoWorker>) => this.#onMessage(data);
      worker.onerror = ({ message }) => {
        for (const { events } of this.#videos.values()) events.onUnsupported(message);
      };
      this.#worker = worker;
    }
    return this.#worker;
  }

  #onMessage(message: FromVideoWorker): void {
    const video = this.#videos.get(message.receiver);
    if (message.type === 'frame') {
      const { frame, rtpTimestamp } = message;
      const { displayWidth: width, displayHeight: height } = frame;
      const image = { image: frame, width, height, rtpTimestamp, close: () => frame.close() };
      if (video === undefined) frame.close();
      else video.events.onFrame({ image, rtpTimestamp, capturedAtMs: null });
    } else if (message.type === 'drops') {
      if (video !== undefined) video.undecoded = message.drops;
    } else video?.events.onUnsupported(message.detail);
  }
}
