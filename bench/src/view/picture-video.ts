/** A drive's pictures as a video, encoded by GStreamer as a robot's cameras are. */
import { availableEncoders, chooseEncoder, VideoProcess } from '@farpoint/video';
import type { DriveFrame } from './simulated-drive.ts';

export interface CodedPicture {
  /** As WebCodecs names it. */
  codec: string;
  key: boolean;
  captureTimeUs: number;
  bytes: Uint8Array;
}

const CODECS = { h264: 'avc1.42e01f', vp8: 'vp8' } as const;
const NS_PER_US = 1000n;
/** The first picture takes as long as the process takes to start. */
const MOST_WAIT_MS = 20_000;
const LOOK_MS = 2;

export class PictureVideo {
  /** Of all pictures so far. */
  bytes = 0;
  /** The encoder's name. */
  readonly encoder: string;
  readonly #codec: string;
  readonly #process: VideoProcess;
  #encoded: PromiseWithResolvers<{ key: boolean; bytes: Uint8Array }> = Promise.withResolvers();

  private constructor(process: VideoProcess, encoder: string, codec: string) {
    this.#process = process;
    this.encoder = encoder;
    this.#codec = codec;
  }

  /** @throws {Error} says what is missing: GStreamer, the program that encodes, or an encoder */
  static async open(bitsPerS: number, framesPerS: number): Promise<PictureVideo> {
    const { encoders } = await availableEncoders();
    const chosen = chooseEncoder(encoders, 'auto');
    if (!chosen.ok) throw new Error(`${chosen.failure.sentence}; ${chosen.failure.remedy}`);
    const { encoder } = chosen;
    const process = new VideoProcess({
      source: { kind: 'frames' },
      encoder,
      settings: { bitsPerS, framesPerS },
      onFrame: ({ key, bytes }) => video.#encoded.resolve({ key, bytes }),
      onFailure: ({ sentence }) => video.#encoded.reject(new Error(sentence)),
    });
    const video = new PictureVideo(process, encoder.name, CODECS[encoder.codec]);
    return video;
  }

  async encode({ rgba, width, height, captureTimeUs }: DriveFrame['picture']): Promise<CodedPicture> {
    await this.#ready();
    this.#encoded = Promise.withResolvers();
    const captureNs = BigInt(captureTimeUs) * NS_PER_US;
    this.#process.pushFrame({
      captureNs,
      format: 'rgba',
      width,
      height,
      stride: 4 * width,
      bytes: rgba,
    });
    const { key, bytes } = await this.#encoded.promise;
    this.bytes += bytes.length;
    return { codec: this.#codec, key, captureTimeUs, bytes };
  }

  close(): Promise<void> {
    return this.#process.close();
  }

  async #ready(): Promise<void> {
    const beganMs = performance.now();
    while (!this.#process.takes) {
      if (performance.now() - beganMs > MOST_WAIT_MS) throw new Error('the encoder takes no picture');
      await new Promise((resolve) => setTimeout(resolve, LOOK_MS));
    }
  }
}
