import type { RateController } from '@farpoint/congestion';
import {
  FMT_FULL_INTRA,
  FMT_GENERIC_NACK,
  FMT_PICTURE_LOSS,
  FMT_TRANSPORT_WIDE,
  mediaSsrcOf,
  parseTransportFeedback,
  RTCP_PAYLOAD_FEEDBACK,
  RTCP_TRANSPORT_FEEDBACK,
  type RtcpPacket,
  readNack,
  readPictureLoss,
  TransportFeedbackAdapter,
  TransportFeedbackError,
  walkRtcp,
} from '@farpoint/rtp';
import { TokenBucket } from '@farpoint/timing';
import type { ReportIntake } from './report-intake.ts';
import type { RtpTransport } from './rtp-transport.ts';

/** Totals since the session began. */
export interface StreamCounters {
  /** Of clouds. */
  framesSent: number;
  packetsSent: number;
  /** On the wire, all headers counted. */
  bytesSent: number;
  pointsSent: number;
  /** Packets not sent because the path was closed. */
  packetsUnsent: number;
  feedbackMessages: number;
  feedbackMalformed: number;
  /** Packets retransmitted because the operator was missing them; not included in `packetsSent`. */
  packetsResent: number;
}

export function emptyStreamCounters(): StreamCounters {
  return {
    framesSent: 0,
    packetsSent: 0,
    bytesSent: 0,
    pointsSent: 0,
    packetsUnsent: 0,
    feedbackMessages: 0,
    feedbackMalformed: 0,
    packetsResent: 0,
  };
}

export interface StreamFeedbackParts {
  /** By stream number; 0 is the clouds' stream. */
  streams: ReadonlyMap<number, RtpTransport>;
  controller: RateController;
  reports: ReportIntake;
  counters: StreamCounters;
}

/** Reads one operator's RTCP: what arrived and when, what to send again, and which videos need a key frame. */
export class StreamFeedback {
  /** The operator cannot show a stream's video until the next key frame. */
  onPictureLoss: ((stream: number) => void) | null = null;
  readonly #parts: StreamFeedbackParts;
  readonly #adapter = new TransportFeedbackAdapter();
  /** A peer that requests every packet again gets a tenth of them. */
  readonly #resends = new TokenBucket({ perSecond: 400, burst: 50 });

  constructor(parts: StreamFeedbackParts) {
    this.#parts = parts;
  }

  /** @param sequence transport-wide sequence number */
  onPacketSent(sequence: number, wireBytes: number, nowMs: number): void {
    this.#adapter.onPacketSent(sequence, wireBytes, nowMs);
  }

  /** @returns whether the rate controller got new information */
  onRtcp(compound: Uint8Array, nowMs: number): boolean {
    const { counters } = this.#parts;
    let changed = false;
    for (const packet of walkRtcp(compound, () => counters.feedbackMalformed++)) {
      changed = this.#onPacket(packet, nowMs) || changed;
    }
    return changed;
  }

  #onPacket(packet: RtcpPacket, nowMs: number): boolean {
    const { reports, counters } = this.#parts;
    const { packetType, format, bytes } = packet;
    // REMB is payload feedback, too.
    if (packetType === RTCP_PAYLOAD_FEEDBACK && (format === FMT_PICTURE_LOSS || format === FMT_FULL_INTRA)) {
      this.#onPictureLoss(bytes);
      return false;
    }
    if (packetType !== RTCP_TRANSPORT_FEEDBACK) {
      const outcome = reports.onRtcp(packet, nowMs);
      if (outcome === 'malformed') counters.feedbackMalformed++;
      return outcome === 'changed';
    }
    if (format === FMT_GENERIC_NACK) this.#onNack(bytes, nowMs);
    return format === FMT_TRANSPORT_WIDE && this.#onArrivals(bytes, nowMs);
  }

  #onArrivals(bytes: Uint8Array, nowMs: number): boolean {
    const { controller, counters } = this.#parts;
    try {
      const results = this.#adapter.onFeedback(parseTransportFeedback(bytes), nowMs);
      counters.feedbackMessages++;
      if (results.length === 0) return false;
      controller.onFeedback(results, nowMs);
      return true;
    } catch (error) {
      if (!(error instanceof TransportFeedbackError)) throw error;
      counters.feedbackMalformed++;
      return false;
    }
  }

  #onPictureLoss(bytes: Uint8Array): void {
    const fault = readPictureLoss(bytes, (ssrc) => {
      const stream = this.#streamOf(ssrc);
      if (stream !== null) this.onPictureLoss?.(stream);
    });
    if (fault !== null) this.#parts.counters.feedbackMalformed++;
  }

  #onNack(bytes: Uint8Array, nowMs: number): void {
    const { streams, counters } = this.#parts;
    const stream = this.#streamOf(mediaSsrcOf(bytes));
    const transport = stream === null ? undefined : streams.get(stream);
    const fault = readNack(bytes, (sequence) => {
      if (!this.#resends.take(nowMs)) return;
      const sent = transport?.resend(sequence, nowMs) ?? 0;
      if (sent === 0) return;
      counters.packetsResent++;
      counters.bytesSent += sent;
    });
    if (fault !== null) counters.feedbackMalformed++;
  }

  #streamOf(ssrc: number | null): number | null {
    for (const [stream, transport] of this.#parts.streams) if (transport.ssrc === ssrc) return stream;
    return null;
  }
}
