import type { VideoCodec } from '@farpoint/protocol';
import type { VideoEncoder } from '@farpoint/video';

const NAMES: Readonly<Record<VideoEncoder['codec'], VideoCodec>> = { h264: 'H264', vp8: 'VP8' };

/** The encoders of one camera: one for each codec, in the order of preference. */
export class CodecEncoders {
  readonly codecs: readonly VideoCodec[];
  readonly #encoders: readonly [VideoEncoder, ...VideoEncoder[]];

  constructor(encoders: readonly [VideoEncoder, ...VideoEncoder[]]) {
    this.#encoders = encoders;
    this.codecs = encoders.map(({ codec }) => NAMES[codec]);
  }

  /** For the log. */
  get names(): string {
    return this.#encoders.map(({ name }) => name).join(', ');
  }

  /** @returns the codec's encoder; without one, the preferred */
  of(codec: VideoCodec): VideoEncoder {
    return this.#encoders[Math.max(0, this.codecs.indexOf(codec))] as VideoEncoder;
  }
}
