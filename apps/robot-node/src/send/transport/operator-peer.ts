/** The WebRTC connection with one operator: the robot offers, the operator answers, ICE trickles. */
import {
  CLOUD_MEDIA,
  CLOUD_STREAM_ID,
  channels,
  type IceCandidate,
  type IceServer,
  MAX_PICTURE_CHUNK_BYTES,
  SOUND_MEDIA,
  SOUND_STREAM_ID,
} from '@farpoint/protocol';
import {
  discardSockets,
  dropDefaultStun,
  guardConnection,
  pairLateCandidates,
  prepareSockets,
  RemoteCandidates,
  startChecks,
} from '@farpoint/webrtc';
import {
  MediaStream,
  type RTCDataChannel,
  type RTCPeerConnection,
  type RTCRtpTransceiver,
  RTP_EXTENSION_URI,
} from 'werift';
import { monotonicMs } from '../../ground/clock.ts';
import { unixOffsetMs } from '../../ground/wall-clock.ts';
import { answerFault } from './answer-fault.ts';
import { AnswerGate, type AnswerVerdict } from './answer-gate.ts';
import { OfferedVideos } from './offered-videos.ts';
import { candidateOf, errorText, openPeerConnection, toWeriftServers } from './open-peer-connection.ts';
import type { OperatorPeerEvents, OperatorPeerOptions, PeerEnd, SoundLine } from './peer-events.ts';
import { RtpTransportError, SrtpTransport } from './srtp-transport.ts';
import { VoiceReceiver } from './voice-receiver.ts';

/** The m-line of one connection for the robot's microphone and the operator's voice. */
class OfferedSound {
  readonly #transceiver: RTCRtpTransceiver;

  constructor(connection: RTCPeerConnection) {
    const streams = [new MediaStream({ id: SOUND_STREAM_ID })];
    this.#transceiver = connection.addTransceiver(SOUND_MEDIA.kind, { direction: 'sendrecv', streams });
  }

  /** Opens the line, if the operator accepted it. Call it once DTLS has connected. */
  connect(): SoundLine {
    const { dtlsTransport, headerExtensions, sender } = this.#transceiver;
    const mid = this.#transceiver.mid ?? '';
    try {
      const transport = new SrtpTransport(this.#transceiver, { rtcp: false, unixOffsetMs: unixOffsetMs() });
      const voice = new VoiceReceiver(dtlsTransport, {
        payloadType: sender.codec?.payloadType ?? -1,
        transportSequenceId:
          headerExtensions.find(({ uri }) => uri === RTP_EXTENSION_URI.transportWideCC)?.id ?? 0,
        now: monotonicMs,
      });
      return { mid, transport, voice };
    } catch (error) {
      if (!(error instanceof RtpTransportError)) throw error;
      return { mid, transport: null, voice: null };
    }
  }
}

/**
 * Bytes on the wire in addition to a message's text: SCTP chunk and header 28, DTLS record 37, UDP and IPv4 28 bytes.
 */
const MESSAGE_OVERHEAD_BYTES = 93;
/**
 * Unreliable messages are dropped while more than this is queued, bytes. Chosen: a quarter of a second at 500
 * kbit/s; what waits longer is old when it arrives.
 */
const MAX_UNRELIABLE_BACKLOG = 16_384;
/**
 * A peer is closed when more than this is queued on its reliable channel, bytes. Chosen: more than a model
 * and all lists together (docs/awareness.md: 100 kB).
 */
const MAX_RELIABLE_BACKLOG = 262_144;

export class OperatorPeer {
  readonly #events: OperatorPeerEvents;
  readonly #connection: RTCPeerConnection;
  readonly #cloud: RTCRtpTransceiver;
  readonly #videos: OfferedVideos;
  readonly #sound: OfferedSound | null;
  readonly #session: RTCDataChannel;
  readonly #telemetry: RTCDataChannel;
  readonly #connectTimer: NodeJS.Timeout;
  readonly #candidates: RemoteCandidates;
  readonly #pictures: RTCDataChannel | null = null;
  #control: RTCDataChannel | null = null;
  #bandwidth: RTCDataChannel | null = null;
  #transport: SrtpTransport | null = null;
  #connected = false;
  #ended = false;
  readonly #answers = new AnswerGate();
  /** An ICE restart has been answered, but its checks wait for the first local candidate. */
  #startDue = false;
  /** Number of ICE restarts offered. */
  restarts = 0;
  /** Bytes of messages on the wire, all headers counted. */
  messageBytesSent = 0;
  /** Messages not sent because the channel was full. */
  unreliableDrops = 0;
  /** Number of channels that the operator opened and we do not know. */
  unknownChannels = 0;

  constructor(options: OperatorPeerOptions, events: OperatorPeerEvents) {
    this.#events = events;
    this.#connection = openPeerConnection(options);
    const connection = this.#connection;
    guardConnection(connection, {
      takesRtp: options.sound === true,
      drives: () => events.drives?.() === true,
      onRefused: (reason) => options.onRefused?.(reason),
      onUnproven: (error) => this.#end('unproven-peer', error.reason),
      onFault: (error) => this.#end('connection-lost', `a message could not be handled: ${errorText(error)}`),
    });
    this.#candidates = new RemoteCandidates(connection, (reason, detail) =>
      events.onCandidateRefused?.(reason, detail),
    );
    // Points travel as "audio": the browser then hands over each packet as it arrives, without assembling frames.
    this.#cloud = connection.addTransceiver(CLOUD_MEDIA.kind, {
      direction: 'sendonly',
      streams: [new MediaStream({ id: CLOUD_STREAM_ID })],
    });
    this.#videos = new OfferedVideos(connection, options.videos ?? []);
    this.#sound = options.sound === true ? new OfferedSound(connection) : null;
    const { session, telemetry } = channels;
    this.#session = connection.createDataChannel(session.label, { ordered: session.ordered });
    this.#telemetry = connection.createDataChannel(telemetry.label, {
      ordered: telemetry.ordered,
      maxPacketLifeTime: telemetry.maxPacketLifeTime,
    });
    if (options.pictures === true) this.#pictures = this.#openPictures();
    this.#listen();
    this.#connectTimer = setTimeout(
      () => this.#end('not-connected', `no connection within ${options.connectTimeoutMs / 1000} s`),
      options.connectTimeoutMs,
    );
  }

  #openPictures(): RTCDataChannel {
    const { pictures } = channels;
    const channel = this.#connection.createDataChannel(pictures.label, {
      ordered: pictures.ordered,
      maxPacketLifeTime: pictures.maxPacketLifeTime,
    });
    channel.bufferedAmountLowThreshold = MAX_PICTURE_CHUNK_BYTES;
    channel.bufferedAmountLow.subscribe(() => {
      // werift emits this in the middle of its own sending.
      setImmediate(() => {
        if (!this.#ended) this.#events.onPicturesLow?.();
      });
    });
    return channel;
  }

  #listen(): void {
    const connection = this.#connection;
    this.#session.onMessage.subscribe((data) => this.#events.onMessage('session', data));
    this.#session.stateChanged.subscribe((state) => {
      if (state === 'open') this.#checkConnected();
      else if (state === 'closed') this.#end('connection-lost', 'the session channel closed');
    });
    connection.onDataChannel.subscribe((channel) => this.#adopt(channel));
    connection.onIceCandidate.subscribe((candidate) => {
      if (candidate === undefined || this.#ended) return;
      prepareSockets(connection);
      this.#checkPairs();
      this.#events.onCandidate(candidateOf(candidate));
    });
    connection.connectionStateChange.subscribe((state) => {
      if (state === 'connected') this.#checkConnected();
      else if (state === 'closed' || (state === 'failed' && !this.#connected)) {
        this.#end(this.#connected ? 'connection-lost' : 'not-connected', `connection ${state}`);
      }
      // After connecting, failed means that consent has expired (RFC 7675). An ICE restart can repair that.
    });
  }

  get connected(): boolean {
    return this.#connected && !this.#ended;
  }

  /** Returns the SDP offer without waiting for STUN or TURN servers. Candidates follow as they are found. */
  async offer(): Promise<string> {
    const description = await this.#connection.createOffer();
    this.#describe(description);
    return description.sdp;
  }

  /**
   * An offer that restarts ICE on new sockets. The DTLS session, SRTP keys and channels stay. Nothing can be sent
   * until the operator has answered it and a path is found. Candidates follow.
   */
  async restart(): Promise<string> {
    const description = await this.#connection.createOffer({ iceRestart: true });
    this.restarts++;
    discardSockets(this.#cloud.dtlsTransport);
    this.#describe(description);
    return description.sdp;
  }

  /** Takes effect with the next restart. */
  useIceServers(iceServers: readonly IceServer[]): void {
    if (!this.#ended) this.#connection.setConfiguration({ iceServers: toWeriftServers(iceServers) });
  }

  /** Whether anything was heard from the peer on the path since the last call, including connectivity checks. */
  heardSinceLast(): boolean {
    return this.#transport?.heardSinceLast() ?? false;
  }

  #describe(description: Awaited<ReturnType<RTCPeerConnection['createOffer']>>): void {
    this.#answers.onOffer();
    this.#startDue = false;
    this.#candidates.hold();
    dropDefaultStun(this.#cloud.dtlsTransport);
    // Resolves only when all candidates have been gathered.
    this.#connection.setLocalDescription(description).catch((error: unknown) => {
      this.#end('not-connected', `no local description: ${errorText(error)}`);
    });
  }

  /** Never throws: a bad answer ends the connection; an answer without a waiting offer changes nothing. */
  async answer(sdp: string): Promise<AnswerVerdict> {
    const verdict = this.#ended ? 'unasked' : this.#answers.judge(sdp);
    if (verdict !== 'taken') return verdict;
    const fault = answerFault(sdp, this.#videos.lines, this.#sound !== null);
    if (fault !== null) {
      this.#end('bad-answer', fault);
      return verdict;
    }
    const dtls = this.#cloud.dtlsTransport;
    const isRestart = dtls.state === 'connected';
    try {
      await this.#candidates.describe('answer', this.#videos.read(sdp));
      this.#startDue = isRestart;
      this.#checkPairs();
    } catch (error) {
      this.#end('bad-answer', errorText(error));
    }
    return verdict;
  }

  /** May be called at any time: a candidate waits for its description. Never throws: it skips unusable ones. */
  addCandidate(candidate: IceCandidate): void {
    if (!this.#ended) this.#candidates.add(candidate);
  }

  /** Reliable and in order. */
  sendSession(text: string): void {
    if (!this.connected) return;
    if (this.#session.bufferedAmount > MAX_RELIABLE_BACKLOG) {
      this.#end('not-reading', 'session messages pile up');
      return;
    }
    this.#send(this.#session, text);
  }

  sendTelemetry(text: string): void {
    this.#sendUnreliable(this.#telemetry, text);
  }

  sendControl(text: string): void {
    if (this.#control !== null) this.#sendUnreliable(this.#control, text);
  }

  /** Bytes of pictures queued for sending. */
  get picturesBuffered(): number {
    return this.#pictures?.bufferedAmount ?? 0;
  }

  /** @returns bytes on the wire, all headers counted; 0 if it cannot be sent */
  sendPicture(chunk: Uint8Array): number {
    const channel = this.#pictures;
    if (channel === null || !this.connected || channel.readyState !== 'open') return 0;
    try {
      channel.send(Buffer.from(chunk.buffer, chunk.byteOffset, chunk.byteLength));
    } catch (error) {
      this.#end('connection-lost', errorText(error));
      return 0;
    }
    return chunk.length + MESSAGE_OVERHEAD_BYTES;
  }

  close(end: PeerEnd = 'closed', detail = ''): void {
    this.#end(end, detail);
  }

  #checkPairs(): void {
    const dtls = this.#cloud.dtlsTransport;
    if (this.#startDue && startChecks(dtls)) this.#startDue = false;
    if (this.#connection.remoteDescription !== undefined) pairLateCandidates(dtls);
  }

  #sendUnreliable(channel: RTCDataChannel, text: string): void {
    if (!this.connected || channel.readyState !== 'open') return;
    if (channel.bufferedAmount > MAX_UNRELIABLE_BACKLOG) {
      this.unreliableDrops++;
      return;
    }
    this.#send(channel, text);
  }

  #send(channel: RTCDataChannel, text: string): void {
    try {
      channel.send(text);
      // Texts are ASCII except for names.
      this.messageBytesSent += text.length + MESSAGE_OVERHEAD_BYTES;
    } catch (error) {
      // The association is closing; the state change that reports it may not have arrived yet.
      this.#end('connection-lost', errorText(error));
    }
  }

  #adopt(channel: RTCDataChannel): void {
    if (channel.label === channels.control.label && this.#control === null) {
      this.#control = channel;
      channel.onMessage.subscribe((data) => this.#events.onMessage('control', data));
    } else if (channel.label === channels.bandwidth.label && this.#bandwidth === null) {
      this.#bandwidth = channel;
      channel.onMessage.subscribe((data) => this.#events.onMessage('bandwidth', data));
    } else if (channel !== this.#session && channel !== this.#telemetry && channel !== this.#pictures) {
      this.unknownChannels++;
      channel.close();
    }
  }

  #checkConnected(): void {
    if (this.#connected || this.#ended) return;
    if (this.#connection.connectionState !== 'connected' || this.#session.readyState !== 'open') return;
    let transport: SrtpTransport;
    try {
      transport = new SrtpTransport(this.#cloud);
    } catch (error) {
      this.#end('bad-answer', errorText(error));
      return;
    }
    clearTimeout(this.#connectTimer);
    this.#connected = true;
    this.#transport = transport;
    this.#events.onConnected(transport, this.#videos.connect(), this.#sound?.connect() ?? null);
  }

  #end(end: PeerEnd, detail: string): void {
    if (this.#ended) return;
    this.#ended = true;
    clearTimeout(this.#connectTimer);
    this.#transport?.close();
    // werift may still be in a handshake; errors while closing no longer matter.
    this.#connection.close().catch(() => undefined);
    this.#events.onEnded(end, detail);
  }
}
