import { SOUND_MEDIA } from '@farpoint/protocol';
import { rtpTimestamp } from '@farpoint/rtp';
import type { SoundPacket } from '@farpoint/sound';
import type { OutgoingFrame } from '../../ground/outgoing-frame.ts';

/**
 * Length of a packet, ms. RFC 6716, 2.1.4: a good choice for most applications; shorter ones would cost more
 * headers than sound.
 */
const SOUND_PACKET_MS = 20;
/** What RTP, its extensions, SRTP, UDP and IP add to each packet, bytes. */
const SOUND_OVERHEAD_BYTES = 76;
/** By which number the sender knows the stream; 0 is for clouds, and videos follow from 1. */
export const SOUND_STREAM = 1000;
/** Sound leaves before videos and clouds: its packets are small, and a gap is heard. */
const LANE = -1000;
/**
 * What has waited for so long is not worth being heard, ms. Chosen: a browser's jitter buffer has given it up
 * by then (docs/sound.md).
 */
const MOST_WAIT_MS = 100;
/**
 * How long a browser can still use a packet that it asks for again, ms. Chromium's jitter buffer has 40 ms on
 * a quiet path (docs/sound.md), and grows with jitter.
 */
const USEFUL_MS = 60;

/** One packet of the microphone on its way to several operators. */
export class SoundFrame implements OutgoingFrame {
  readonly stream = SOUND_STREAM;
  readonly lane = LANE;
  readonly packets = 1;
  readonly bytes: number;
  readonly points = 0;
  readonly marked = false;
  readonly rtpTimestamp: number;
  readonly capturedAtMs: number;
  readonly usefulMs = USEFUL_MS;
  readonly maxWaitingFrames = MOST_WAIT_MS / SOUND_PACKET_MS;
  readonly #payload: Uint8Array;

  constructor({ bytes, capturedAtMs }: SoundPacket) {
    this.#payload = bytes;
    this.bytes = bytes.length + SOUND_OVERHEAD_BYTES;
    this.capturedAtMs = capturedAtMs;
    this.rtpTimestamp = rtpTimestamp(capturedAtMs, SOUND_MEDIA.clockRate);
  }

  payload(): Uint8Array {
    return this.#payload;
  }

  /** Nothing is reused: packets are small. */
  hold(): this {
    return this;
  }

  release(): void {}
}

/** What sound takes on the wire, bit/s. @param bitsPerSecond the encoder's rate */
export function soundWireRate(bitsPerSecond: number): number {
  return bitsPerSecond + OVERHEAD_BITS_PER_SECOND;
}

/** The encoder's rate that takes this much on the wire, bit/s; negative if headers alone take more. */
export function soundRateWithin(wireBitsPerSecond: number): number {
  return wireBitsPerSecond - OVERHEAD_BITS_PER_SECOND;
}

const OVERHEAD_BITS_PER_SECOND = (SOUND_OVERHEAD_BYTES * 8 * 1000) / SOUND_PACKET_MS;
