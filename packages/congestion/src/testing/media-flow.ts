import type { EventQueue, Path, Random, Stalls } from '@farpoint/network-sim';
import {
  type PacketStatus,
  SequenceNumber,
  type TransportFeedback,
  TransportFeedbackAdapter,
} from '@farpoint/rtp';
import { BitRate } from '@farpoint/timing';
import { type PacedFrame, PacketPacer } from '../pacer.ts';
import type { ProbeRequest, RateController, RateSnapshot } from '../rate-controller.ts';
import { FlowRecord } from './flow-record.ts';

export interface MediaFlowOptions {
  name?: string;
  controller: RateController;
  forward: Path;
  /** The path of the feedback. */
  back: Path;
  startMs?: number;
  stopMs?: number;
  /** Pauses: no frames between these times, ms. */
  pauses?: readonly (readonly [number, number])[];
  /** The most the source has to send per frame, bytes; with `probes` false, padding does not exceed it either. */
  maxFrameBytes?: number;
  /** Whether the source sends probes. Default true. */
  probes?: boolean;
  /** Sends whole frames at once instead of pacing them. */
  bursts?: boolean;
  /** The receiver reports its sums and gives no transport-wide feedback. */
  reports?: boolean;
  /** Bounds of the interval between two feedback messages, ms. */
  feedbackMs?: readonly [number, number];
  /** Fraction of feedback messages that arrive twice, 0–1. */
  duplicateFeedback?: number;
  /** Times at which the receiver's clock jumps, and by how much, ms. */
  clockJumps?: readonly (readonly [number, number])[];
  /** The receiver's clock is faster by this many millionths. */
  clockSkewPpm?: number;
  /** When sender and receiver stall. Delays of the arrivals themselves belong to the forward path. */
  senderStalls?: Stalls | null;
  receiverStalls?: Stalls | null;
}

interface SimFrame extends PacedFrame {
  createdMs: number;
}

const PACKET_BYTES = 1244;
const FRAME_MS = 1000 / 30;
const UPDATE_EVERY_MS = 25;
/** The most packets that the receiver remembers for feedback; older ones are never reported. */
const RECEIVER_WINDOW = 1 << 15;

/**
 * A robot and an operator that behave as the robot's sender and Chromium's receiver do: paced frames at 30 per second,
 * as large as the target allows; feedback at intervals; window and probes obeyed.
 */
export class MediaFlow {
  readonly record: FlowRecord;
  readonly #events: EventQueue;
  readonly #random: Random;
  readonly #options: MediaFlowOptions;
  readonly #controller: RateController;
  readonly #pacer = new PacketPacer<SimFrame>(1e6, { factor: 1 });
  readonly #adapter = new TransportFeedbackAdapter();
  readonly #startMs: number;
  readonly #stopMs: number;
  #sequence = 0;
  #budgetBytes = 0;
  #wakeMs = Number.POSITIVE_INFINITY;
  #probeCluster = 0;
  #probeBytesLeft = 0;
  #probeNextMs = 0;
  #probeRate = 0;
  // The receiver: arrival times by unwrapped sequence number, until reported.
  readonly #arrivals = new Float64Array(RECEIVER_WINDOW);
  #highestArrived = -1;
  #nextToReport = 0;
  #received = 0;
  #sentMs: number[] = [];

  constructor(events: EventQueue, random: Random, options: MediaFlowOptions) {
    this.#events = events;
    this.#random = random;
    this.#options = options;
    this.#controller = options.controller;
    this.#startMs = options.startMs ?? 0;
    this.#stopMs = options.stopMs ?? Number.POSITIVE_INFINITY;
    this.record = new FlowRecord(options.name ?? 'media');
    this.#arrivals.fill(Number.NaN);
    this.#senderAt(this.#startMs, () => {
      this.#frame(this.#startMs);
      this.#update();
    });
    events.at(this.#startMs + this.#feedbackInterval(), () => this.#report());
  }

  get snapshot(): RateSnapshot {
    return this.#controller.snapshot(this.#events.nowMs);
  }

  #frame(dueMs: number): void {
    const now = this.#events.nowMs;
    if (now >= this.#stopMs) {
      this.#pacer.clear();
      return;
    }
    const next = dueMs + FRAME_MS;
    this.#senderAt(next, () => this.#frame(next));
    if (this.#options.pauses?.some(([from, to]) => now >= from && now < to)) return;
    const target = this.#controller.decision(now).targetBitsPerSecond;
    const most = this.#options.maxFrameBytes ?? Number.POSITIVE_INFINITY;
    const bytes = Math.min(BitRate.bytesIn(target, FRAME_MS), most);
    // Whole packets only; the remainder goes to the next frame, as with a planner that counts points.
    this.#budgetBytes = Math.min(this.#budgetBytes + bytes, bytes + PACKET_BYTES);
    const count = Math.floor(this.#budgetBytes / PACKET_BYTES);
    this.#budgetBytes -= count * PACKET_BYTES;
    if (count === 0) return;
    this.#pacer.enqueue({ packets: count, bytes: count * PACKET_BYTES, createdMs: now }, now);
    this.#pump();
  }

  #update(): void {
    const now = this.#events.nowMs;
    if (now >= this.#stopMs) return;
    this.#controller.update(now);
    this.record.sample(now, this.#controller);
    this.#pump();
    this.#senderAt(now + UPDATE_EVERY_MS, () => this.#update());
  }

  #pump(): void {
    const now = this.#events.nowMs;
    const decision = this.#controller.decision(now);
    if (this.#options.probes !== false) this.#takeProbe(decision.probe, now);
    const paced = this.#options.bursts ? 1e9 : decision.pacingBitsPerSecond;
    const probing = this.#probeBytesLeft > 0;
    this.#pacer.setRate(probing ? Math.max(this.#probeRate, paced) : paced);
    for (;;) {
      if (decision.bytesInFlight >= decision.congestionWindowBytes) return;
      const run = this.#pacer.due(now);
      if (run === null) break;
      for (let i = 0; i < run.count; i++) this.#send(run.frame.createdMs, now);
      this.#controller.decision(now);
    }
    while (this.#probeBytesLeft > 0 && this.#probeNextMs <= now + 1) this.#send(now, now);
    const next = Math.min(
      this.#pacer.nextDueMs ?? Number.POSITIVE_INFINITY,
      this.#probeBytesLeft > 0 ? this.#probeNextMs : Number.POSITIVE_INFINITY,
    );
    // A wake-up for an outdated rate does no harm: pacer and probe know their own times.
    if (next < Number.POSITIVE_INFINITY && (next < this.#wakeMs || this.#wakeMs <= now)) {
      const at = Math.max(next, now + 0.25);
      this.#wakeMs = at;
      this.#senderAt(at, () => {
        if (this.#wakeMs === at) this.#wakeMs = Number.POSITIVE_INFINITY;
        this.#pump();
      });
    }
  }

  #takeProbe(probe: Readonly<ProbeRequest> | null, now: number): void {
    if (probe === null) {
      this.#probeBytesLeft = 0;
      return;
    }
    if (probe.clusterId === this.#probeCluster) return;
    this.#probeCluster = probe.clusterId;
    this.#probeBytesLeft = probe.bytes;
    this.#probeRate = probe.bitsPerSecond;
    this.#probeNextMs = now;
  }

  #send(createdMs: number, now: number): void {
    const cluster = this.#probeBytesLeft > 0 ? this.#probeCluster : 0;
    if (cluster !== 0) {
      this.#probeBytesLeft -= PACKET_BYTES;
      this.#probeNextMs = Math.max(this.#probeNextMs, now - 2) + BitRate.msFor(this.#probeRate, PACKET_BYTES);
    }
    const sequence = this.#sequence++;
    if (this.#options.reports) this.#sentMs[sequence] = now;
    const carried = SequenceNumber.of(sequence);
    this.#adapter.onPacketSent(carried, PACKET_BYTES, now);
    this.#controller.onPacketSent(carried, PACKET_BYTES, now, cluster);
    this.record.sent(PACKET_BYTES, now);
    this.#options.forward.send(PACKET_BYTES, {
      dropped: (reason) => this.record.dropped(now, reason),
      delivered: (arrivalMs, queueMs) => {
        this.record.delivered(PACKET_BYTES, now, arrivalMs, queueMs, createdMs);
        this.#receive(sequence, arrivalMs);
      },
    });
  }

  #receive(sequence: number, arrivalMs: number): void {
    if (sequence < this.#nextToReport) return;
    this.#arrivals[sequence % RECEIVER_WINDOW] = this.#receiverClock(arrivalMs);
    if (sequence > this.#highestArrived) this.#highestArrived = sequence;
    this.#received++;
  }

  #receiverClock(atMs: number): number {
    let clock = atMs * (1 + (this.#options.clockSkewPpm ?? 0) / 1e6) + 1e6;
    for (const [when, by] of this.#options.clockJumps ?? []) if (atMs >= when) clock += by;
    return clock;
  }

  #feedbackInterval(): number {
    const [least, most] = this.#options.feedbackMs ?? [50, 62];
    return least + (most - least) * this.#random.next();
  }

  #report(): void {
    const now = this.#events.nowMs;
    if (now > this.#stopMs + 5000) return;
    const next = now + this.#feedbackInterval();
    this.#events.at(this.#options.receiverStalls?.after(next) ?? next, () => this.#report());
    if (this.#highestArrived < this.#nextToReport) return;
    if (this.#options.reports) {
      this.#sendSums();
      return;
    }
    const packets: PacketStatus[] = [];
    const first = Math.max(this.#nextToReport, this.#highestArrived - RECEIVER_WINDOW + 1);
    for (let sequence = first; sequence <= this.#highestArrived; sequence++) {
      const at = sequence % RECEIVER_WINDOW;
      const arrival = this.#arrivals[at] as number;
      const received = !Number.isNaN(arrival);
      this.#arrivals[at] = Number.NaN;
      // The wire format has a resolution of 250 µs.
      packets.push({
        sequence: SequenceNumber.of(sequence),
        received,
        arrivalUs: received ? Math.round(arrival * 4) * 250 : null,
      });
    }
    this.#nextToReport = this.#highestArrived + 1;
    const bytes = 60 + Math.ceil(packets.length * 1.25);
    const feedback: TransportFeedback = {
      senderSsrc: 1,
      mediaSsrc: 2,
      baseSequence: SequenceNumber.of(first),
      referenceTimeUs: 0,
      feedbackCount: 0,
      packets,
    };
    const deliver = () => {
      const results = this.#adapter.onFeedback(feedback, this.#events.nowMs);
      if (results.length > 0) this.#controller.onFeedback(results, this.#events.nowMs);
      this.#pump();
    };
    const twice = this.#random.chance(this.#options.duplicateFeedback ?? 0);
    this.#options.back.send(bytes, {
      dropped: () => {},
      delivered: (arrivalMs) => {
        this.#senderAt(arrivalMs, deliver);
        if (twice) this.#senderAt(arrivalMs + 3, deliver);
      },
    });
  }

  /** As in a receiver report: how many packets arrived, and the highest number. */
  #sendSums(): void {
    const highest = this.#highestArrived;
    const packetsReceived = this.#received;
    const deliver = () => {
      const now = this.#events.nowMs;
      const rttMs = now - (this.#sentMs[highest] as number);
      const packetsLost = highest + 1 - packetsReceived;
      this.#controller.onReceiverReport({ packetsReceived, packetsLost, source: 'rtcp', rttMs }, now);
      this.#pump();
    };
    this.#options.back.send(80, {
      dropped: () => {},
      delivered: (arrivalMs) => this.#senderAt(arrivalMs, deliver),
    });
  }

  /** Schedules work of the sender's process. */
  #senderAt(atMs: number, action: () => void): void {
    this.#events.at(this.#options.senderStalls?.after(atMs) ?? atMs, action);
  }
}
