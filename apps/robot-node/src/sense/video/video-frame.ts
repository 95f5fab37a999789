import { VIDEO_CLOCK_RATE, type VideoCodec } from '@farpoint/protocol';
import { packetiseH264, packetiseVp8, rtpTimestamp } from '@farpoint/rtp';
import { FRESH_FRAME_MS, type OutgoingFrame } from '../../ground/outgoing-frame.ts';

/** The payload of a packet, at most, bytes: with all headers, 1,280 bytes fit every path (RFC 8200 §5). */
const MAX_PAYLOAD_BYTES = 1180;
/** What RTP, its extensions, SRTP, UDP and IP add to each packet, bytes. */
export const VIDEO_OVERHEAD_BYTES = 76;
/**
 * How long a browser can still use a late packet, ms: it waits for it with the picture on hold. As long as it
 * may wait for its turn.
 */
const USEFUL_MS = FRESH_FRAME_MS;
/** Videos leave before clouds: their frames are small, and a decoder waits for each of them. */
const FIRST_LANE = -64;

/** One encoded picture of a camera. */
export interface EncodedPicture {
  /** H.264: an access unit as Annex B; VP8: a frame. */
  bytes: Uint8Array;
  key: boolean;
  /** On the robot's clock, ms. */
  capturedAtMs: number;
  width: number;
  height: number;
}

/** The frames of a video are numbered for VP8's picture id. */
export interface VideoFrameOptions {
  /** The video's number. */
  video: number;
  codec: VideoCodec;
  pictureId: number;
  framesPerSecond: number;
}

/** One encoded picture on its way to several operators, packetised once for all of them. */
export class VideoFrame implements OutgoingFrame {
  readonly video: number;
  readonly stream: number;
  readonly lane: number;
  readonly codec: VideoCodec;
  readonly key: boolean;
  readonly packets: number;
  readonly bytes: number;
  readonly points = 0;
  readonly rtpTimestamp: number;
  readonly capturedAtMs: number;
  readonly usefulMs = USEFUL_MS;
  readonly maxSpanMs = FRESH_FRAME_MS;
  readonly maxWaitingFrames: number;
  readonly needsPrevious: boolean;
  readonly #payloads: readonly Uint8Array[];

  /** @throws {VideoPayloadError} if the bytes are no picture of the codec */
  constructor(picture: EncodedPicture, { video, codec, pictureId, framesPerSecond }: VideoFrameOptions) {
    const { bytes, key, capturedAtMs } = picture;
    this.#payloads =
      codec === 'H264'
        ? packetiseH264(bytes, MAX_PAYLOAD_BYTES)
        : packetiseVp8(bytes, pictureId, MAX_PAYLOAD_BYTES);
    this.video = video;
    this.codec = codec;
    this.stream = streamOfVideo(video);
    this.lane = FIRST_LANE + video;
    this.key = key;
    this.needsPrevious = !key;
    this.packets = this.#payloads.length;
    this.bytes = this.#payloads.reduce(
      (sum, payload) => sum + payload.length,
      this.packets * VIDEO_OVERHEAD_BYTES,
    );
    this.rtpTimestamp = rtpTimestamp(capturedAtMs, VIDEO_CLOCK_RATE);
    this.capturedAtMs = capturedAtMs;
    this.maxWaitingFrames = Math.max(2, Math.ceil((FRESH_FRAME_MS * framesPerSecond) / 1000));
  }

  payload(index: number): Uint8Array {
    return this.#payloads[index] as Uint8Array;
  }

  /** Nothing is reused: encoded pictures are small. */
  hold(): this {
    return this;
  }

  release(): void {}
}

/** The sender's stream 0 carries clouds. */
export function streamOfVideo(video: number): number {
  return video + 1;
}

export function videoOfStream(stream: number): number {
  return stream - 1;
}
