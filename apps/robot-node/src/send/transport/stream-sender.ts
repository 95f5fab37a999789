import {
  type FrameDropReason,
  PacketPacer,
  type ProbeRequest,
  type RateController,
  type RateSnapshot,
} from '@farpoint/congestion';
import type { ResendRefusal } from '@farpoint/rtp';
import type { OutgoingFrame } from '../../ground/outgoing-frame.ts';
import { FrameFit } from './frame-fit.ts';
import { ReportIntake } from './report-intake.ts';
import type { RtpTransport } from './rtp-transport.ts';
import { emptyStreamCounters, StreamFeedback } from './stream-feedback.ts';

/** The number of the clouds' stream. */
const CLOUD_STREAM = 0;
/**
 * Packets leave in bursts of this length, ms. Waking up for each packet would cost more than sending it.
 * Chosen: at 41 Mbit/s, ten packets; the receiver's queue grows by as much.
 */
const BURST_MS = 2.5;
/**
 * Twice as many, sent after a late wake-up, still fit a socket buffer of 212,992 bytes, the most that Linux gives a browser
 * by default: a packet of 1,250 bytes takes some 2,300 of it, and the kernel doubles the size.
 */
const BURST_BYTES = 64_000;
/**
 * A probe train waits this many frames for a frame of its length. After that, a frame of at least this many
 * packets is enough. Chosen: an eighth of a second at 30 a second; probe-tester.ts needs five packets, twenty
 * tell more (docs/congestion.md).
 */
const PATIENT_FRAMES = 4;
const SHORT_TRAIN_PACKETS = 20;

/** A frame has been sent to its last packet. */
export interface SentFrame {
  frame: OutgoingFrame;
  /** Time from the first packet to the last, ms. */
  sendMs: number;
}

/** When packets of a frame were handed to the transport, ms on the robot's clock. */
export interface FrameDeparture {
  firstMs: number;
  /** Of the last packet so far. */
  lastMs: number;
}

/**
 * What is streamed to one operator: clouds, and the videos of cameras. Takes whole frames, sends their packets evenly
 * at the rate that the controller allows, and reports the result to the controller. It owns no timer: call `pump` at
 * `nextDueMs`.
 */
export class StreamSender {
  readonly counters = emptyStreamCounters();
  onFrameSent: ((sent: SentFrame) => void) | null = null;
  onFrameDropped: ((frame: OutgoingFrame, reason: FrameDropReason) => void) | null = null;
  /** Called for each packet sent, with its index in the frame and the robot's clock. For measurements. */
  onPacketSent: ((frame: OutgoingFrame, index: number, sentMs: number) => void) | null = null;
  /** The rate controller got new information: what may be sent, and when, has changed. */
  onRateChanged: (() => void) | null = null;
  /** The clouds' stream; the operator's feedback on all streams arrives here. */
  readonly #transport: RtpTransport;
  /** By stream number. */
  readonly #streams: Map<number, RtpTransport>;
  readonly #controller: RateController;
  readonly #pacer: PacketPacer<OutgoingFrame>;
  readonly #feedback: StreamFeedback;
  readonly #reports: ReportIntake;
  readonly #fit = new FrameFit();
  readonly #now: () => number;
  readonly #departures = new WeakMap<OutgoingFrame, FrameDeparture>();
  readonly #cloudDrops: Record<FrameDropReason, number> = {
    superseded: 0,
    overdue: 0,
    undecodable: 0,
    cleared: 0,
  };
  /** The probe that is being sent, its rate, and its remaining bytes. */
  #probeCluster = 0;
  #probeBitsPerSecond = 0;
  #probeBytesLeft = 0;
  /** Number of consecutive frames that were shorter than the requested train. */
  #framesTooShort = 0;
  /** When RTCP from the operator last arrived, ms. */
  heardMs = 0;

  constructor(transport: RtpTransport, controller: RateController, now: () => number) {
    this.#transport = transport;
    this.#streams = new Map([[CLOUD_STREAM, transport]]);
    this.#controller = controller;
    this.#reports = new ReportIntake(transport, controller);
    this.#now = now;
    // The controller decides how much faster than planned packets may go.
    this.#pacer = new PacketPacer(controller.decision(now()).pacingBitsPerSecond, {
      factor: 1,
      burstMs: BURST_MS,
      burstBytes: BURST_BYTES,
    });
    const { counters } = this;
    this.#feedback = new StreamFeedback({
      streams: this.#streams,
      controller,
      reports: this.#reports,
      counters,
    });
    transport.onRtcp = (compound) => {
      this.heardMs = this.#now();
      if (this.#feedback.onRtcp(compound, this.heardMs)) this.onRateChanged?.();
    };
  }

  /** @param stream the number by which frames name it, not 0 */
  addStream(stream: number, transport: RtpTransport): void {
    this.#streams.set(stream, transport);
  }

  /** @param handler called with a stream whose video the operator cannot show before the next key frame */
  set onPictureLoss(handler: (stream: number) => void) {
    this.#feedback.onPictureLoss = handler;
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

  /** Frames of clouds that were dropped, wholly or in part, by reason. */
  get droppedFrames(): Readonly<Record<FrameDropReason, number>> {
    return this.#cloudDrops;
  }

  /** When a frame, or the part of it that was sent, left; `null` if nothing of it has. */
  departureOf(frame: OutgoingFrame): Readonly<FrameDeparture> | null {
    return this.#departures.get(frame) ?? null;
  }

  /** How often a retransmission was refused, by reason. */
  get resendRefusals(): Readonly<Record<ResendRefusal, number>> {
    return this.#transport.resendRefusals;
  }

  /** `null` also while too much is in flight; feedback or the next update will change that. */
  get nextDueMs(): number | null {
    return this.#windowFull ? null : this.#pacer.nextDueMs;
  }

  /** Retains the frame and sends it in its turn, unless a newer one comes first. */
  enqueue(outgoing: OutgoingFrame): void {
    if (outgoing.packets === 0) return;
    this.#takeProbe(outgoing);
    for (const { frame, reason } of this.#pacer.enqueue(outgoing.hold(), this.#now())) {
      // A frame that waits for the congestion window is not late through our own fault.
      if (!this.#windowFull && frame.stream === CLOUD_STREAM) this.#fit.onCut();
      this.#drop(frame, reason);
    }
  }

  #drop(frame: OutgoingFrame, reason: FrameDropReason): void {
    if (frame.stream === CLOUD_STREAM) this.#cloudDrops[reason]++;
    this.onFrameDropped?.(frame, reason);
    frame.release();
  }

  /**
   * Uses the frame as the probe train if it has the requested length. If frames stay shorter, a whole frame is
   * enough: otherwise a source that has no more to give would never learn how fast its frames may go.
   */
  #takeProbe(frame: OutgoingFrame): void {
    const wish = this.probeWish;
    if (wish === null) {
      this.#framesTooShort = 0;
      return;
    }
    // Frames in other lanes are not sized for probes.
    if (frame.lane !== 0) return;
    if (frame.bytes < wish.bytes) {
      this.#framesTooShort++;
      if (this.#framesTooShort <= PATIENT_FRAMES || frame.packets < SHORT_TRAIN_PACKETS) return;
    }
    this.#framesTooShort = 0;
    this.#probeCluster = wish.clusterId;
    this.#probeBitsPerSecond = wish.bitsPerSecond;
    this.#probeBytesLeft = Math.min(wish.bytes, frame.bytes);
  }

  /** Sends what is due now. */
  pump(): void {
    for (;;) {
      const now = this.#now();
      if (this.#windowFull) return;
      this.#setPace(now);
      const run = this.#pacer.due(now);
      if (run === null) return;
      const { frame, first, count, last } = run;
      const departure = this.#departures.get(frame) ?? { firstMs: now, lastMs: now };
      if (first === 0) this.#departures.set(frame, departure);
      const { rtpTimestamp, usefulMs, capturedAtMs, codec } = frame;
      const transport = this.#streams.get(frame.stream) ?? this.#transport;
      for (let i = first; i < first + count; i++) {
        const payload = frame.payload(i);
        const marker = i === frame.packets - 1 && frame.marked !== false;
        const sequence = transport.send(payload, rtpTimestamp, marker, now, usefulMs, capturedAtMs, codec);
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
        this.onPacketSent?.(frame, i, this.#now());
        this.counters.packetsSent++;
        this.counters.bytesSent += wireBytes;
      }
      departure.lastMs = this.#now();
      if (!last) continue;
      if (frame.stream === CLOUD_STREAM) {
        this.#fit.onSent();
        this.counters.framesSent++;
        this.counters.pointsSent += frame.points;
      }
      this.onFrameSent?.({ frame, sendMs: departure.lastMs - departure.firstMs });
      frame.release();
    }
  }

  /** Lets the controller decide anew, and the pacer follow. Call this every 25 ms or so. */
  update(): void {
    const now = this.#now();
    this.#controller.update(now);
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
    for (const { frame, reason } of this.#pacer.clear()) this.#drop(frame, reason);
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
