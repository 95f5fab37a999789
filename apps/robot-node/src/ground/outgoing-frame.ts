import type { PacedFrame } from '@farpoint/congestion';
import type { VideoCodec } from '@farpoint/protocol';

/**
 * The longest time that a cloud or a video's frame may take from its capture until it is sent, ms; what is older is not
 * worth its bytes. Chosen: from this age of the view on, the robot is slower unless `motion.viewSlowMs` says otherwise.
 */
export const FRESH_FRAME_MS = 250;

/** One frame on its way to several operators, cut into the payloads of RTP packets. */
export interface OutgoingFrame extends PacedFrame {
  readonly lane: number;
  /** The RTP stream that carries it, by the number under which the sender knows its transport; 0 for clouds. */
  readonly stream: number;
  /** What a video's frame is coded with: its payload type follows from it. */
  readonly codec?: VideoCodec;
  /** Points in it; 0 for a video's frame. */
  readonly points: number;
  /** RTP timestamp, u32 in units of the stream's clock. */
  readonly rtpTimestamp: number;
  /** When it was captured, ms on the robot's clock; for streams that carry the time in each packet. */
  readonly capturedAtMs: number;
  /** For how long a packet may be retransmitted on request, ms. */
  readonly usefulMs: number;
  /** Whether its last packet has RTP's marker bit; it has if undefined. Of sound, each packet is a frame of its own. */
  readonly marked?: boolean;
  /** The payload of a packet, without a copy. */
  payload(index: number): Uint8Array;
  /** Every holder releases the frame once; its memory is reused when the last one has. */
  hold(): this;
  release(): void;
}
