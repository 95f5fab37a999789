/**
 * The interface between what is sent and how: one RTP stream to one operator. Pacing, frames and rates are
 * above it; RTP, SRTP and sockets below it.
 */

import type { ReceiverSums } from '@farpoint/congestion';
import type { VideoCodec } from '@farpoint/protocol';
import type { ReportBlock, ResendRefusal } from '@farpoint/rtp';

/** Bytes of UDP and IPv4 headers per packet on the wire. */
export const UDP_IPV4_BYTES = 28;

export interface RtpTransport {
  /** The stream's SSRC, by which feedback names it. */
  readonly ssrc: number;
  /** Bytes added to each payload on the wire: RTP header, SRTP tag, UDP and IP. */
  readonly overheadBytes: number;
  /** False before the path is up and after it is closed. */
  readonly ready: boolean;

  /**
   * Sends one payload immediately or not at all: nothing is queued.
   *
   * @param timestamp RTP timestamp, u32 in units of the stream's clock, the same for all packets of a frame
   * @param marker set on the last packet of a frame
   * @param nowMs robot's clock
   * @param usefulMs how long the packet may be retransmitted on request
   * @param capturedAtMs when the frame was captured, robot's clock; streams that do not carry it ignore it
   * @param codec what a video's payload is coded with; others have one payload type only
   * @returns the packet's transport-wide sequence number (u16), or `null` if the path is closed or the peer does not
   *   take the codec
   */
  send(
    payload: Uint8Array,
    timestamp: number,
    marker: boolean,
    nowMs: number,
    usefulMs: number,
    capturedAtMs?: number,
    codec?: VideoCodec,
  ): number | null;

  /**
   * Retransmits a packet that the peer is missing, byte for byte, if that is still useful.
   *
   * @param sequence RTP sequence number
   * @returns bytes on the wire, 0 if it was not sent
   */
  resend(sequence: number, nowMs: number): number;
  /** How often a retransmission was refused, by reason. */
  readonly resendRefusals: Readonly<Record<ResendRefusal, number>>;

  /** Whether the peer has agreed to give transport-wide feedback. */
  readonly transportFeedback: boolean;

  /** What a block of a receiver report says about our stream; `null` for a block about another stream. */
  receiverSums(block: Readonly<ReportBlock>, nowMs: number): ReceiverSums | null;

  /** Raw RTCP compound packets from the peer, decrypted: those on all streams of its bundle. */
  onRtcp: ((compound: Uint8Array) => void) | null;
}
