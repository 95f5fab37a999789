/**
 * The seam between what is sent and how: one operator's unreliable path for cloud packets. Pacing, frames and rates lie
 * above it; RTP, SRTP and sockets below it.
 */

import type { ReceiverSums } from '@farpoint/congestion';
import type { ReportBlock, ResendRefusal } from '@farpoint/rtp';

/** What a packet costs on the wire beyond its payload, bytes. */
export const UDP_IPV4_BYTES = 28;

export interface CloudTransport {
  /** Bytes that each payload grows by on the wire: RTP header, SRTP tag, UDP and IP. */
  readonly overheadBytes: number;
  /** False before the path is up and after it is gone. */
  readonly ready: boolean;

  /**
   * Sends one payload now, or not at all: nothing is queued.
   *
   * @param timestamp RTP timestamp, u32 in 1/48000 s, the same for all packets of a frame
   * @param marker on the last packet of a frame
   * @param nowMs robot's clock
   * @param usefulMs for so long it may be sent again, where it is missed
   * @returns the transport-wide sequence number (u16) it went out under, or `null` where the path is closed
   */
  send(
    payload: Uint8Array,
    timestamp: number,
    marker: boolean,
    nowMs: number,
    usefulMs: number,
  ): number | null;

  /**
   * Sends a packet again that the peer misses, the same bytes, where that is of use.
   *
   * @param sequence RTP sequence number
   * @returns bytes on the wire, 0 where it was not sent
   */
  resend(sequence: number, nowMs: number): number;
  /** How often a missed packet was not sent again, by reason. */
  readonly resendRefusals: Readonly<Record<ResendRefusal, number>>;

  /** Whether the peer has agreed to give transport-wide feedback. */
  readonly transportFeedback: boolean;

  /** What a block of a receiver report says of our stream; `null` for one about another. */
  receiverSums(block: Readonly<ReportBlock>, nowMs: number): ReceiverSums | null;

  /** Raw RTCP compound packets from the peer, decrypted. */
  onRtcp: ((compound: Uint8Array) => void) | null;
}
