/** The WebRTC connection to one robot. Whatever the robot sends, and whatever fails, affects only this connection. */
import { Buffer } from 'node:buffer';
import { encodeBandwidth, encodeJsonBytes, referenceControlCodec, type Twist } from '@farpoint/protocol';
import { createReferencePeerConnection, referenceChannels } from '@farpoint/reference-profile';
import { BitRate, RateMeter } from '@farpoint/timing';
import { prepareSockets, RemoteCandidates } from '@farpoint/webrtc';
import type { RTCDataChannel, RTCPeerConnection } from 'werift';
import { type AssembledFrame, FrameAssembler } from './frame-assembler.ts';
import { ReceiverLimit } from './receiver-limit.ts';
import { RtpReceiver } from './rtp-receiver.ts';

export interface RobotConnectionOptions {
  maxPoints: number;
  reorderMs: number;
  startBitsPerSecond: number;
  maxBitsPerSecond: number;
  now: () => number;
}

export interface RobotConnectionEvents {
  onCandidate: (candidate: string) => void;
  /** @param lastPacketMs when the last packet of the frame arrived */
  onFrame: (frame: AssembledFrame, lastPacketMs: number) => void;
  /** The channel for `start` and `stop` is open. */
  onReady: () => void;
  onFailed: (detail: string) => void;
}

/** Why a command was not passed on. */
export type CommandDrop = 'channel-not-open' | 'backlog';

/** Commands are dropped beyond this backlog, bytes: a command that waits behind others is worse than none. */
const MAX_COMMAND_BACKLOG = 4096;
const MAX_REPORT_BACKLOG = 4096;
/** IP, UDP, RTP and SRTP overhead per packet, bytes. */
const OVERHEAD_BYTES = 64;

export class RobotConnection {
  readonly assembler: FrameAssembler;
  packets = 0;
  /** Number of the robot's candidates that were left out. */
  candidatesRefused = 0;
  /** Number of datagrams that were dropped unread. */
  datagramsRefused = 0;
  readonly #options: RobotConnectionOptions;
  readonly #events: RobotConnectionEvents;
  readonly #connection: RTCPeerConnection;
  readonly #candidates: RemoteCandidates;
  readonly #limit: ReceiverLimit;
  readonly #received = new RateMeter();
  readonly #words: RTCDataChannel;
  readonly #bandwidth: RTCDataChannel;
  #control: RTCDataChannel | null = null;
  #receiver: RtpReceiver | null = null;
  #closed = false;
  #shown = false;
  #bytes = 0;
  #lastPacketMs = Number.NEGATIVE_INFINITY;
  #timer: NodeJS.Timeout | null = null;

  constructor(options: RobotConnectionOptions, events: RobotConnectionEvents) {
    this.#options = options;
    this.#events = events;
    this.#limit = new ReceiverLimit(options);
    this.assembler = new FrameAssembler(options, (frame) => this.#onFrame(frame));
    const connection = createReferencePeerConnection(
      {},
      {
        onRefused: () => {
          this.datagramsRefused++;
        },
        onUnproven: (error) => this.#fail(`the robot is not the one that registered: ${error.reason}`),
        onFault: (error) => this.#fail(textOf(error)),
      },
    );
    this.#connection = connection;
    this.#candidates = new RemoteCandidates(connection, () => {
      this.candidatesRefused++;
    });
    connection.onIceCandidate.subscribe((candidate) => {
      if (candidate === undefined || this.#closed) return;
      prepareSockets(connection);
      events.onCandidate(candidate.toJSON().candidate);
    });
    connection.connectionStateChange.subscribe((state) => {
      if (state === 'failed') this.#fail('the connection failed');
      else if (state === 'connected') this.#receive();
    });
    connection.onDataChannel.subscribe((channel) => {
      if (channel.label === referenceChannels.control.label && this.#control === null) {
        this.#control = channel;
        channel.stateChanged.subscribe((state) => {
          if (state === 'closed') this.#fail('the robot closed its control channel');
        });
      }
    });
    const { bandwidth, words } = referenceChannels;
    this.#bandwidth = connection.createDataChannel(bandwidth.label, { ordered: bandwidth.ordered });
    this.#words = connection.createDataChannel(words.label, {
      ordered: words.ordered,
      maxRetransmits: words.maxRetransmits,
    });
    this.#words.stateChanged.subscribe((state) => {
      if (state === 'open' && !this.#closed) events.onReady();
    });
  }

  /** Whether the robot is shown. Only then are its packets decrypted and assembled into frames. */
  get shown(): boolean {
    return this.#shown;
  }

  set shown(shown: boolean) {
    this.#shown = shown;
    if (this.#receiver !== null) this.#receiver.paused = !shown;
  }

  /** Whether the path was up at the last check. */
  get connected(): boolean {
    return !this.#closed && this.#connection.connectionState === 'connected';
  }

  /** When points last arrived while it was shown, ms. */
  get lastPacketMs(): number {
    return this.#lastPacketMs;
  }

  /** Packets that arrived while it was not shown, or were invalid. */
  get packetsRefused(): number {
    return this.#receiver?.refused ?? 0;
  }

  get packetsLost(): number {
    return this.#receiver?.requests.lost ?? 0;
  }

  get packetsRecovered(): number {
    return this.#receiver?.requests.recovered ?? 0;
  }

  /**
   * Answers an offer, also for a renegotiation. @returns the SDP answer, or `null` if the offer is unusable; the
   * connection has then failed
   */
  async answer(offer: string): Promise<string | null> {
    try {
      await this.#candidates.describe('offer', offer);
      const answer = await this.#connection.createAnswer();
      // Resolves only when all candidates have been gathered; they are sent one by one.
      this.#connection.setLocalDescription(answer).catch((error: unknown) => this.#fail(textOf(error)));
      return this.#closed ? null : answer.sdp;
    } catch (error) {
      this.#fail(textOf(error));
      return null;
    }
  }

  /**
   * May be called at any time: a candidate waits for the offer. Never throws: unusable candidates are counted, and
   * others may work.
   */
  addCandidate(candidate: string): void {
    if (!this.#closed) this.#candidates.add({ candidate, sdpMLineIndex: 0 });
  }

  /** Does nothing before the channel is open; see `onReady`. */
  tell(word: 'start' | 'stop'): void {
    this.#send(this.#words, word);
  }

  /** @returns why the command was dropped, or `null` */
  command(twist: Twist): CommandDrop | null {
    const channel = this.#control;
    if (channel === null || channel.readyState !== 'open') return 'channel-not-open';
    if (channel.bufferedAmount > MAX_COMMAND_BACKLOG) return 'backlog';
    this.#send(channel, Buffer.from(encodeJsonBytes(referenceControlCodec, twist)));
    return null;
  }

  close(): void {
    if (this.#closed) return;
    this.#closed = true;
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#receiver?.close();
    this.assembler.clear();
    this.#connection.close().catch(() => undefined);
  }

  /** Takes over the stream from werift. */
  #receive(): void {
    const dtls = this.#connection.dtlsTransports[0];
    if (dtls === undefined || this.#receiver !== null || this.#closed) return;
    try {
      this.#receiver = new RtpReceiver(dtls, this.#options, (payload) => this.#onPayload(payload));
      this.#receiver.paused = !this.#shown;
    } catch (error) {
      this.#fail(textOf(error));
    }
  }

  #onPayload(payload: Uint8Array): void {
    this.packets++;
    const nowMs = this.#options.now();
    this.#bytes += payload.byteLength + OVERHEAD_BYTES;
    this.#lastPacketMs = nowMs;
    this.assembler.accept(payload, nowMs);
    this.#arm();
  }

  #arm(): void {
    const due = this.assembler.nextDueMs;
    if (due === null || this.#timer !== null) return;
    this.#timer = setTimeout(
      () => {
        this.#timer = null;
        this.assembler.expire(this.#options.now());
        this.#arm();
      },
      Math.max(0, due - this.#options.now()),
    );
  }

  #onFrame(frame: AssembledFrame): void {
    this.#events.onFrame(frame, this.#lastPacketMs);
    this.#received.update(this.#bytes, this.#options.now());
    const lossRate = 1 - frame.points / frame.expectedPoints;
    const limit = this.#limit.onFrame(lossRate, BitRate.fromBytesPerSecond(this.#received.perSecond));
    if (this.#bandwidth.bufferedAmount <= MAX_REPORT_BACKLOG) {
      this.#send(this.#bandwidth, Buffer.from(encodeBandwidth(limit)));
    }
  }

  #send(channel: RTCDataChannel, data: string | Buffer): void {
    if (this.#closed || channel.readyState !== 'open') return;
    try {
      channel.send(data);
    } catch (error) {
      this.#fail(textOf(error));
    }
  }

  #fail(detail: string): void {
    if (this.#closed) return;
    this.close();
    this.#events.onFailed(detail);
  }
}

function textOf(error: unknown): string {
  return (error instanceof Error ? error.message : String(error)).slice(0, 300);
}
