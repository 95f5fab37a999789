import type { RateController } from '@farpoint/congestion';
import {
  decodeBandwidth,
  decodeJson,
  decodeStreamSwitch,
  FULL_POINT_PACKET_BYTES,
  POINTS_PER_PACKET,
  ProtocolError,
  referenceControlCodec,
} from '@farpoint/protocol';
import type { OutgoingFrame } from '../../ground/outgoing-frame.ts';
import type { Budgets } from '../../send/budgets/budgets.ts';
import type { CloudClaim } from '../../send/budgets/cloud-shares.ts';
import { FrameReceiver } from '../../send/clouds/frame-receiver.ts';
import type { PacketLog } from '../../send/transport/packet-log.ts';
import type { PeerEnd } from '../../send/transport/peer-events.ts';
import type { SendLoop } from '../../send/transport/send-loop.ts';
import { SharedFrame } from '../../send/transport/shared-frame.ts';
import type { SrtpTransport } from '../../send/transport/srtp-transport.ts';
import { StreamSender } from '../../send/transport/stream-sender.ts';
import { slotSequenceOffset } from '../../sense/encode/packetiser.ts';
import type { SessionHost } from '../session/operator-messages.ts';
import { ReferenceDriver } from './reference-driver.ts';
import { ReferencePeer, type ReferencePeerOptions } from './reference-peer.ts';
import { ReferenceTransport } from './reference-transport.ts';
import { ReportedLimit } from './reported-limit.ts';

/** What a reference operator needs from the robot. */
export type ReferenceHost = Pick<
  SessionHost,
  'drive' | 'now' | 'leaseChanged' | 'commandAccepted' | 'commandRejected' | 'messageRefused'
> & { requestLatencyFrame(): void };

export interface ReferenceOperatorOptions {
  /** The operator's id for the guard. No Farpoint session has this id. */
  id: string;
  peer: ReferencePeerOptions;
  controller: RateController;
  /** Whether an operator's hand may have held on since a session before. */
  mayHold?: (() => boolean) | undefined;
  packetLog?: PacketLog | undefined;
  /** Told when streaming begins or pauses, or when the rate changes. */
  budgets: Pick<Budgets, 'update'>;
}

export interface ReferenceOperatorEvents {
  onCandidate(candidate: string): void;
  onConnected(): void;
  onEnded(end: PeerEnd, detail: string): void;
}

/**
 * After this long without hearing from the operator, ms: points are no longer sent; it no longer drives; it
 * is gone. Chosen: the first as for our own operators (docs/connection.md); the others are shorter, because
 * it has no session that is restored.
 */
const QUIET_MS = 2000;
const LEASE_MS = 1000;
const GONE_MS = 5000;

/** The reference profile has a single sensor, and a single format, which is not one of ours. */
const ONE_SENSOR: readonly CloudClaim[] = [
  { priority: 0, weight: 1, usefulBitsPerSecond: Number.POSITIVE_INFINITY },
];

/** One operator of the reference system: connection, commands and stream. */
export class ReferenceOperator extends FrameReceiver {
  readonly id: string;
  readonly peer: ReferencePeer;
  readonly driver: ReferenceDriver;
  readonly #host: ReferenceHost;
  readonly #sendLoop: SendLoop;
  readonly #options: ReferenceOperatorOptions;
  readonly #events: ReferenceOperatorEvents;
  #limit: ReportedLimit | null = null;
  /** What the rate control was last told, bit/s on the wire. */
  #appliedLimit = Number.POSITIVE_INFINITY;
  /** As with the reference system's robot, nothing is sent before the operator starts the stream. */
  #started = false;
  #quiet = false;
  #heardMs = 0;
  #greenWanted = false;

  constructor(
    options: ReferenceOperatorOptions,
    host: ReferenceHost,
    sendLoop: SendLoop,
    events: ReferenceOperatorEvents,
  ) {
    super(() => ONE_SENSOR);
    this.id = options.id;
    this.#options = options;
    this.#host = host;
    this.#sendLoop = sendLoop;
    this.#events = events;
    this.driver = new ReferenceDriver(options.id, host.drive.guard, options.mayHold);
    this.peer = new ReferencePeer(options.peer, {
      onCandidate: (candidate) => events.onCandidate(candidate),
      onConnected: (transport) => this.#onConnected(transport),
      onMessage: (channel, data) => this.#onMessage(channel, data),
      onEnded: (end, detail) => this.#onEnded(end, detail),
    });
  }

  get streaming(): boolean {
    return this.sender !== null && this.#started && !this.#quiet;
  }

  /** Nothing else is sent to it. */
  protected override cloudPart(targetBitsPerSecond: number): number {
    return targetBitsPerSecond;
  }

  silentMs(nowMs: number): number {
    return nowMs - this.heardMs;
  }

  /** When the operator was last heard from, ms on the robot's clock. */
  get heardMs(): number {
    return Math.max(this.#heardMs, this.sender?.heardMs ?? 0);
  }

  enqueue(shared: SharedFrame): void {
    const { sender } = this;
    if (sender === null || !this.streaming) return;
    const frame = toReferenceFrame(shared, sender.overheadBytes);
    if (frame === null) return;
    sender.enqueue(frame);
    frame.release();
  }

  /** Updates the sender, and acts on silence. Call this every 25 ms. */
  update(): void {
    const now = this.#host.now();
    if (this.peer.heardSinceLast()) this.#heardMs = now;
    this.sender?.update();
    if (this.sender === null) return;
    const silentMs = this.silentMs(now);
    this.#quiet = silentMs > QUIET_MS;
    if (this.driver.checkQuiet(now, silentMs < LEASE_MS)) {
      this.#host.drive.apply();
      this.#host.leaseChanged('expired');
    }
    if (silentMs > GONE_MS) this.peer.close('silent', `nothing heard for ${GONE_MS / 1000} s`);
  }

  #onMessage(channel: 'control' | 'bandwidth' | 'words', data: string | Uint8Array): void {
    this.#heardMs = this.#host.now();
    try {
      if (channel === 'control') this.#onControl(data);
      else if (channel === 'bandwidth') this.#onBandwidth(data);
      else this.#onWord(data);
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.#host.messageRefused(`reference-${channel}`, error);
      if (channel !== 'control') return;
      this.#host.commandRejected(
        this.#host.drive.guard.onMalformed(this.id, error.message.slice(0, 200), this.#heardMs),
      );
    }
  }

  #onControl(data: string | Uint8Array): void {
    const { drive } = this.#host;
    const hadLease = this.driver.holdsLease;
    const verdict = this.driver.onTwist(decodeJson(referenceControlCodec, data), this.#heardMs);
    drive.apply();
    if (this.driver.holdsLease !== hadLease) this.#host.leaseChanged();
    if (verdict === 'latency-test') {
      this.#greenWanted = true;
      this.#host.requestLatencyFrame();
    } else if (typeof verdict === 'object') {
      if (verdict.accepted) this.#host.commandAccepted();
      else this.#host.commandRejected(verdict);
    }
  }

  #onBandwidth(data: string | Uint8Array): void {
    if (typeof data === 'string')
      throw new ProtocolError('invalid', 'bandwidth message', '', 'text, not bytes');
    this.#limit?.reported(decodeBandwidth(data));
    this.#applyLimit();
  }

  #applyLimit(): void {
    const limit = this.#limit?.bitsPerSecond ?? Number.POSITIVE_INFINITY;
    if (limit === this.#appliedLimit) return;
    this.#appliedLimit = limit;
    this.sender?.onReceiverLimit(limit);
    this.#options.budgets.update();
  }

  /** Text or the same bytes: the reference system's robot treats both alike. */
  #onWord(data: string | Uint8Array): void {
    const word = typeof data === 'string' ? data : new TextDecoder().decode(data.subarray(0, 16));
    const started = decodeStreamSwitch(word) === 'start';
    if (started === this.#started) return;
    this.#started = started;
    if (!started) this.sender?.clear();
    this.#options.budgets.update();
  }

  #onConnected(inner: SrtpTransport): void {
    const transport = new ReferenceTransport(inner, () => this.#host.now());
    const sender = new StreamSender(transport, this.#options.controller, () => this.#host.now());
    const { packetLog } = this.#options;
    if (packetLog !== undefined)
      sender.onPacketSent = (frame, index, sentMs) => {
        if (frame instanceof SharedFrame)
          packetLog.add(transport.frameNumber, slotSequenceOffset(frame.slots, index), sentMs);
      };
    sender.onFrameSent = ({ frame }) => {
      if (isGreen(frame)) this.#greenWanted = false;
      if (frame instanceof SharedFrame) this.driver.sentCaptureMs = frame.frame.capturedAtMs;
      this.#limit?.sent(frame.packets, this.#host.now());
      this.#applyLimit();
    };
    sender.onFrameDropped = (frame) => {
      if (isGreen(frame) && this.#greenWanted) this.#host.requestLatencyFrame();
    };
    sender.onRateChanged = () => {
      this.#options.budgets.update();
      this.#sendLoop.run();
    };
    this.#limit = new ReportedLimit(FULL_POINT_PACKET_BYTES + inner.overheadBytes);
    this.#heardMs = this.#host.now();
    this.sender = sender;
    this.#sendLoop.add(sender);
    this.#events.onConnected();
  }

  #onEnded(end: PeerEnd, detail: string): void {
    const { sender } = this;
    const { drive } = this.#host;
    this.sender = null;
    if (sender !== null) {
      this.#sendLoop.remove(sender);
      sender.clear();
    }
    const leaseFreed = drive.guard.operatorGone(this.id);
    drive.apply();
    if (leaseFreed) this.#host.leaseChanged('session-ended');
    this.#events.onEnded(end, detail);
  }
}

function isGreen(frame: OutgoingFrame): boolean {
  return frame instanceof SharedFrame && frame.frame.latencyTest;
}

/**
 * A frame as the reference profile sends it: whole packets only. It shares the original frame's buffer and holds it
 * until it is released itself. It leaves out the points beyond the last whole packet, which are the farthest.
 *
 * @param overheadBytes bytes that the reference transport adds to each payload on the wire
 * @returns `null` if there is no whole packet. The caller must `release` the frame
 */
export function toReferenceFrame(shared: SharedFrame, overheadBytes: number): SharedFrame | null {
  const packets = Math.floor(shared.frame.points / POINTS_PER_PACKET);
  if (packets === 0) return null;
  const held = shared.hold();
  const frame = { ...shared.frame, packets, points: packets * POINTS_PER_PACKET };
  return new SharedFrame(frame, overheadBytes, () => held.release());
}
