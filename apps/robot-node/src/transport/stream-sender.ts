import {
  type FrameDropReason,
  PacketPacer,
  type ProbeRequest,
  type RateController,
  type RateSnapshot,
} from '@farpoint/congestion';
import {
  FMT_GENERIC_NACK,
  FMT_TRANSPORT_WIDE,
  parseTransportFeedback,
  type ResendRefusal,
  RTCP_TRANSPORT_FEEDBACK,
  readNack,
  TransportFeedbackAdapter,
  TransportFeedbackError,
  walkRtcp,
} from '@farpoint/rtp';
import { TokenBucket } from '@farpoint/timing';
import { slotPayload, slotSequenceOffset } from '../encode/packetiser.ts';
import type { CloudTransport } from './cloud-transport.ts';
import { FrameFit } from './frame-fit.ts';
import { ReportIntake } from './report-intake.ts';
import type { SharedFrame } from './shared-frame.ts';
import { emptyStreamCounters } from './stream-counters.ts';

/** Packets leave in bursts of this length, ms. Waking up for each packet would cost more than sending it. */
const BURST_MS = 2.5;
/**
 * A probe train waits this many frames for a frame of its length. After that, a frame of at least this many packets
 * is enough.
 */
const PATIENT_FRAMES = 4;
const SHORT_TRAIN_PACKETS = 20;

/** A frame has been sent to its last packet. */
export interface SentFrame {
  shared: SharedFrame;
  /** Time from the first packet to the last, ms. */
  sendMs: number;
}

/**
 * One operator's stream. Takes whole frames, sends their packets evenly at the rate that the controller allows, and
 * reports the result to the controller. It owns no timer: call `pump` at `nextDueMs`.
 */
export class StreamSender {
  readonly counters = emptyStreamCounters();
  onFrameSent: ((sent: SentFrame) => void) | null = null;
  onFrameDropped: ((shared: SharedFrame, reason: FrameDropReason) => void) | null = null;
  /**
   * Called for each packet sent, with the frame number, the offset of its data in the frame, and the robot's clock.
   * For measurements.
   */
  onPacketSent: ((frameNumber: number, sequenceOffset: number, sentMs: number) => void) | null = null;
  /** The rate controller got new information: what may be sent, and when, has changed. */
  onRateChanged: (() => void) | null = null;
  readonly #transport: CloudTransport;
  readonly #controller: RateController;
  readonly #pacer: PacketPacer<SharedFrame>;
  readonly #feedback = new TransportFeedbackAdapter();
  readonly #reports: ReportIntake;
  readonly #fit = new FrameFit();
  /** A peer that requests every packet again gets a tenth of them. */
  readonly #resends = new TokenBucket({ perSecond: 400, burst: 50 });
  readonly #now: () => number;
  readonly #beganMs = new WeakMap<SharedFrame, number>();
  /** The probe that is being sent, its rate, and its remaining bytes. */
  #probeCluster = 0;
  #probeBitsPerSecond = 0;
  #probeBytesLeft = 0;
  /** Number of consecutive frames that were shorter than the requested train. */
  #framesTooShort = 0;
  /** When RTCP from the operator last arrived, ms. */
  heardMs = 0;

  constructor(transport: CloudTransport, controller: RateController, now: () => number) {
    this.#transport = transport;
    this.#controller = controller;
    this.#reports = new ReportIntake(transport, controller);
    this.#now = now;
    // The controller decides how much faster than planned packets may go.
    this.#pacer = new PacketPacer(controller.decision(now()).pacingBitsPerSecond, {
      factor: 1,
      burstMs: BURST_MS,
    });
    transport.onRtcp = (compound) => this.#onRtcp(compound);
  }

  get overheadBytes(): number {
    return this.#transport.overheadBytes;
  }

  get targetBitsPerSecond(): number {
    return this.#controller.targetBitsPerSecond(this.#now());
  }

  /** The share of the target to plan for with points, 0–1. It is below 1 if frames cannot be sent whole. */
  get fit(): number {
    return this.#fit.share;
  }

  /** The rate controller's state, for people. */
  get rate(): RateSnapshot {
    return this.#controller.snapshot(this.#now());
  }

  /** The packet train that the rate controller wants. A frame with at least this many bytes carries it. */
  get probeWish(): Readonly<ProbeRequest> | null {
    const { probe } = this.#controller.decision(this.#now());
    return probe === null || probe.clusterId === this.#probeCluster ? null : probe;
  }

  get droppedFrames(): Readonly<Record<FrameDropReason, number>> {
    return this.#pacer.drops;
  }

  /** How often a retransmission was refused, by reason. */
  get resendRefusals(): Readonly<Record<ResendRefusal, number>> {
    return this.#transport.resendRefusals;
  }

  /** `null` also while too much is in flight; feedback or the next tick will change that. */
  get nextDueMs(): number | null {
    return this.#windowFull ? null : this.#pacer.nextDueMs;
  }

  /** Retains the frame and sends it in its turn, unless a newer one comes first. */
  enqueue(shared: SharedFrame): void {
    if (shared.packets === 0) return;
    this.#takeProbe(shared);
    for (const { frame, reason } of this.#pacer.enqueue(shared.hold(), this.#now())) {
      // A frame that waits for the congestion window is not late through our own fault.
      if (!this.#windowFull) this.#fit.onCut();
      this.onFrameDropped?.(frame, reason);
      frame.release();
    }
  }

  /**
   * Uses the frame as the probe train if it has the requested length. If frames stay shorter, a whole frame is
   * enough: otherwise a source that has no more to give would never learn how fast its frames may go.
   */
  #takeProbe(shared: SharedFrame): void {
    const wish = this.probeWish;
    if (wish === null) {
      this.#framesTooShort = 0;
      return;
    }
    // Frames in other lanes are not sized for probes.
    if (shared.lane !== 0) return;
    if (shared.bytes < wish.bytes) {
      this.#framesTooShort++;
      if (this.#framesTooShort <= PATIENT_FRAMES || shared.packets < SHORT_TRAIN_PACKETS) return;
    }
    this.#framesTooShort = 0;
    this.#probeCluster = wish.clusterId;
    this.#probeBitsPerSecond = wish.bitsPerSecond;
    this.#probeBytesLeft = Math.min(wish.bytes, shared.bytes);
  }

  /** Sends what is due now. */
  pump(): void {
    const transport = this.#transport;
    for (;;) {
      const now = this.#now();
      if (this.#windowFull) return;
      this.#setPace(now);
      const run = this.#pacer.due(now);
      if (run === null) return;
      const { frame: shared, first, count, last } = run;
      if (first === 0) this.#beganMs.set(shared, now);
      const { points } = shared.frame;
      for (let i = first; i < first + count; i++) {
        const payload = slotPayload(shared.slots, i);
        const marker = i === shared.packets - 1;
        const sequence = transport.send(payload, shared.rtpTimestamp, marker, now, shared.frame.intervalMs);
        if (sequence === null) {
          this.counters.packetsUnsent++;
          continue;
        }
        const wireBytes = payload.length + transport.overheadBytes;
        this.#feedback.onPacketSent(sequence, wireBytes, now);
        this.#controller.onPacketSent(
          sequence,
          wireBytes,
          now,
          this.#probeBytesLeft > 0 ? this.#probeCluster : 0,
        );
        this.#probeBytesLeft -= wireBytes;
        this.onPacketSent?.(shared.frame.frameNumber, slotSequenceOffset(shared.slots, i), this.#now());
        this.counters.packetsSent++;
        this.counters.bytesSent += wireBytes;
      }
      if (!last) continue;
      this.#fit.onSent();
      this.counters.framesSent++;
      this.counters.pointsSent += points;
      this.onFrameSent?.({ shared, sendMs: this.#now() - (this.#beganMs.get(shared) ?? now) });
      shared.release();
    }
  }

  /** Call this every 25 ms or so. */
  tick(): void {
    const now = this.#now();
    this.#controller.onTick(now);
    this.#setPace(now);
  }

  /** Whether the operator gives transport-wide feedback. */
  get transportFeedback(): boolean {
    return this.#transport.transportFeedback;
  }

  onReceiverReport({ packetsReceived, packetsLost }: { packetsReceived: number; packetsLost: number }): void {
    this.#reports.onOwnSums(packetsReceived, packetsLost, this.#now());
    if (!this.transportFeedback) this.onRateChanged?.();
  }

  onReceiverLimit(bitsPerSecond: number): void {
    this.#reports.onOwnLimit(bitsPerSecond, this.#now());
  }

  /** Drops everything queued, because the stream was stopped or the session is over. */
  clear(): void {
    for (const { frame, reason } of this.#pacer.clear()) {
      this.onFrameDropped?.(frame, reason);
      frame.release();
    }
  }

  #onRtcp(compound: Uint8Array): void {
    this.heardMs = this.#now();
    let changed = false;
    for (const packet of walkRtcp(compound, () => this.counters.feedbackMalformed++)) {
      if (packet.packetType !== RTCP_TRANSPORT_FEEDBACK) {
        const outcome = this.#reports.onRtcp(packet, this.#now());
        if (outcome === 'malformed') this.counters.feedbackMalformed++;
        changed ||= outcome === 'changed';
        continue;
      }
      if (packet.format === FMT_GENERIC_NACK) this.#onNack(packet.bytes);
      if (packet.format !== FMT_TRANSPORT_WIDE) continue;
      try {
        const now = this.#now();
        const results = this.#feedback.onFeedback(parseTransportFeedback(packet.bytes), now);
        this.counters.feedbackMessages++;
        if (results.length === 0) continue;
        this.#controller.onFeedback(results, now);
        changed = true;
      } catch (error) {
        if (!(error instanceof TransportFeedbackError)) throw error;
        this.counters.feedbackMalformed++;
      }
    }
    if (changed) this.onRateChanged?.();
  }

  #onNack(bytes: Uint8Array): void {
    const now = this.#now();
    const fault = readNack(bytes, (sequence) => {
      if (!this.#resends.take(now)) return;
      const sent = this.#transport.resend(sequence, now);
      if (sent === 0) return;
      this.counters.packetsResent++;
      this.counters.bytesSent += sent;
    });
    if (fault !== null) this.counters.feedbackMalformed++;
  }

  get #windowFull(): boolean {
    const { bytesInFlight, congestionWindowBytes } = this.#controller.decision(this.#now());
    return bytesInFlight >= congestionWindowBytes;
  }

  #setPace(nowMs: number): void {
    const { pacingBitsPerSecond } = this.#controller.decision(nowMs);
    const probing = this.#probeBytesLeft > 0;
    this.#pacer.setRate(
      probing ? Math.max(this.#probeBitsPerSecond, pacingBitsPerSecond) : pacingBitsPerSecond,
    );
  }
}
