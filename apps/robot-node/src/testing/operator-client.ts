/** An operator for tests: a werift peer that answers the robot's offer as a browser would. */

import {
  channels,
  decodeJson,
  emptyPlacement,
  emptyPointPacketHeader,
  type IceCandidate,
  type OperatorControlMessage,
  type OperatorSessionMessage,
  PictureAssembler,
  pointsOfBytes,
  type Reading,
  type RobotSessionMessage,
  readCloudPayload,
  robotSessionCodec,
  type Sample,
  type Telemetry,
  type TelemetryMessage,
  telemetryCodec,
  VIDEO_CODECS,
  type VideoCodec,
  type WholePicture,
} from '@farpoint/protocol';
import { ABS_CAPTURE_TIME_URI } from '@farpoint/rtp';
import { Waiters } from '@farpoint/service/testing/waiters';
import { helloAtOnce, mendSctp } from '@farpoint/webrtc/testing';
import {
  type RTCDataChannel,
  RTCPeerConnection,
  RTCRtpCodecParameters,
  RTCRtpHeaderExtensionParameters,
  useSdesMid,
  useTransportWideCC,
  useTWCC,
} from 'werift';
import { videoCodecParameters } from '../send/transport/media-codecs.ts';
import { type DriveExtras, DrivingHand, namedRelease } from './driving-hand.ts';
import { SoundReception } from './sound-reception.ts';
import { type ReceivedVideo, VideoReception } from './video-reception.ts';

/** What has been received of one frame so far. */
export interface ReceivedFrame {
  frameNumber: number;
  packets: number;
  points: number;
  latencyTest: boolean;
  complete: boolean;
}

export interface DtlsKeys {
  keyPem: string;
  certPem: string;
  signatureHash: { hash: 4; signature: 3 };
}

export interface OperatorClientOptions {
  /** Keys for a certificate that does not match; by default, werift makes them. */
  keys?: DtlsKeys | undefined;
  /** Begins the DTLS handshake without werift's usual pause. */
  helloAtOnce?: boolean | undefined;
  /** The video codecs that it decodes; default both. */
  videoCodecs?: readonly VideoCodec[] | undefined;
  /** Whether to give transport-wide feedback; default `true`. */
  transportFeedback?: boolean | undefined;
}

export class OperatorClient {
  readonly connection: RTCPeerConnection;
  readonly session: RobotSessionMessage[] = [];
  readonly control: RTCDataChannel;
  /** Frames of sensor 0, by frame number. */
  readonly frames = new Map<number, ReceivedFrame>();
  readonly #framesOf = new Map([[0, this.frames]]);
  onCandidate: ((candidate: IceCandidate) => void) | null = null;
  /** Called with each readable packet of a cloud. */
  onCloudPacket: ((payload: Buffer) => void) | null = null;
  /** The newest picture of each camera. */
  readonly pictures = new Map<number, WholePicture>();
  readonly #assembler = new PictureAssembler();
  readonly #video: VideoReception;
  readonly sound: SoundReception;
  telemetry: Telemetry | null = null;
  /** Of each type, the newest. */
  readonly newest: { [T in TelemetryMessage['type']]?: Extract<TelemetryMessage, { type: T }> } = {};
  readonly samples: Sample[] = [];
  /** The newest reading of each topic. */
  readonly readings = new Map<string, Reading>();
  packets = 0;
  malformedPackets = 0;
  readonly #waiters = new Waiters();
  readonly #bandwidth: RTCDataChannel;
  readonly #helloAtOnce: boolean;
  #sessionChannel: RTCDataChannel | null = null;
  #probes: NodeJS.Timeout | null = null;
  readonly #hand = new DrivingHand(this.session);

  constructor({
    keys,
    transportFeedback = true,
    videoCodecs = VIDEO_CODECS,
    ...options
  }: OperatorClientOptions = {}) {
    this.#helloAtOnce = options.helloAtOnce ?? false;
    const extensions = transportFeedback ? [useSdesMid(), useTransportWideCC()] : [useSdesMid()];
    const captureTime = new RTCRtpHeaderExtensionParameters({ uri: ABS_CAPTURE_TIME_URI });
    const rtcpFeedback = transportFeedback ? [useTWCC()] : [];
    this.connection = new RTCPeerConnection({
      iceServers: [],
      bundlePolicy: 'max-bundle',
      codecs: {
        audio: [
          new RTCRtpCodecParameters({ mimeType: 'audio/opus', clockRate: 48_000, channels: 2, rtcpFeedback }),
        ],
        video: videoCodecs.map((codec) => videoCodecParameters(codec)),
      },
      headerExtensions: { audio: extensions, video: [...extensions, captureTime] },
      ...(keys === undefined ? {} : { dtls: { keys } }),
    });
    const { connection } = this;
    this.#video = new VideoReception(connection, () => this.#waiters.changed());
    this.sound = new SoundReception(connection, () => this.#waiters.changed());
    connection.onTrack.subscribe((track) => {
      if (track.kind === 'video') this.#video.add(track);
      else if (!this.sound.add(track))
        track.onReceiveRtp.subscribe((packet) => this.#onPayload(packet.payload));
    });
    connection.onIceCandidate.subscribe((candidate) => {
      if (candidate === undefined) return;
      const { candidate: text, sdpMid, sdpMLineIndex } = candidate.toJSON();
      this.onCandidate?.({ candidate: text, sdpMid: sdpMid ?? null, sdpMLineIndex: sdpMLineIndex ?? null });
    });
    connection.onDataChannel.subscribe((channel) => {
      if (channel.label === 'session') this.#sessionChannel = channel;
      channel.onMessage.subscribe((data) => {
        if (channel.label === 'session') this.session.push(decodeJson(robotSessionCodec, data));
        else if (channel.label === 'pictures') this.#onPicture(data);
        else if (channel.label === 'telemetry') this.#onTelemetry(decodeJson(telemetryCodec, data));
        this.#waiters.changed();
      });
    });
    const { control, bandwidth } = channels;
    // werift takes a count of 0 for "reliable", so this uses 1; a browser uses 0.
    this.control = connection.createDataChannel(control.label, {
      ordered: control.ordered,
      maxRetransmits: 1,
    });
    this.#bandwidth = connection.createDataChannel(bandwidth.label, { ordered: bandwidth.ordered });
    // A browser loses nothing of what is reliable.
    if (connection.sctpTransport !== undefined) mendSctp(connection.sctpTransport);
    this.control.stateChanged.subscribe(() => this.#waiters.changed());
    this.control.onMessage.subscribe(() => this.#waiters.changed());
    connection.connectionStateChange.subscribe(() => this.#waiters.changed());
  }

  /** @returns the SDP answer */
  async answer(offer: string): Promise<string> {
    await this.connection.setRemoteDescription({ type: 'offer', sdp: offer });
    this.sound.acceptBoth();
    if (this.#helloAtOnce) helloAtOnce(this.connection);
    await this.connection.setLocalDescription(await this.connection.createAnswer());
    return this.connection.localDescription?.sdp ?? '';
  }

  /** Resolves as soon as `is` returns true. It is evaluated whenever something arrives. */
  until(is: () => boolean): Promise<void> {
    return this.#waiters.until(is);
  }

  /** Resolves with the latest message of a type, waiting for the first if necessary. */
  async message<T extends RobotSessionMessage['type']>(
    type: T,
    is: (message: Extract<RobotSessionMessage, { type: T }>) => boolean = () => true,
  ): Promise<Extract<RobotSessionMessage, { type: T }>> {
    let found: Extract<RobotSessionMessage, { type: T }> | undefined;
    await this.until(() => {
      found = this.session.findLast(
        (message): message is Extract<RobotSessionMessage, { type: T }> =>
          message.type === type && is(message as Extract<RobotSessionMessage, { type: T }>),
      );
      return found !== undefined;
    });
    return found as Extract<RobotSessionMessage, { type: T }>;
  }

  /** Resolves when connected, welcomed, and able to send commands. Probes the robot's clock from then on. */
  async ready(): Promise<void> {
    await this.message('welcome');
    await this.until(() => this.control.readyState === 'open');
    this.#probes = setInterval(() => {
      this.sendControl({ type: 'clockProbe', id: 1, sentMs: performance.now() });
    }, 500);
  }

  sendControl(message: OperatorControlMessage): void {
    this.control.send(JSON.stringify(message));
  }

  sendSession(message: OperatorSessionMessage): void {
    this.#sessionChannel?.send(JSON.stringify(message));
  }

  sendBandwidth(bytes: Uint8Array): void {
    this.#bandwidth.send(Buffer.from(bytes));
  }

  async takeLease(): Promise<string> {
    this.sendSession({ type: 'leaseRequest', take: false });
    const { lease } = await this.message('lease', (message) => message.holder === 'you');
    return lease ?? '';
  }

  /** Names the latest latch of the emergency stop. */
  releaseEstop(): void {
    this.sendSession(namedRelease(this.session));
  }

  /** Lets go once when the robot has asked for it. */
  drive(lease: string, linear: number, more: DriveExtras = {}): void {
    this.sendControl(this.#hand.command(lease, linear, more));
  }

  /** By the `mid` of its m-line. */
  get videos(): ReadonlyMap<string, ReceivedVideo> {
    return this.#video.videos;
  }

  get completeFrames(): ReceivedFrame[] {
    return this.completeFramesOf(0);
  }

  completeFramesOf(sensor: number): ReceivedFrame[] {
    return [...(this.#framesOf.get(sensor)?.values() ?? [])].filter((frame) => frame.complete);
  }

  /** Stops receiving and sending, like a machine whose power is cut. */
  async vanish(): Promise<void> {
    if (this.#probes !== null) clearInterval(this.#probes);
    for (const { connection } of this.connection.iceTransports) await connection.close();
  }

  async close(): Promise<void> {
    if (this.#probes !== null) clearInterval(this.#probes);
    await this.connection.close();
  }

  #onPicture(data: string | Buffer): void {
    const cameras = this.session.findLast(({ type }) => type === 'cameras');
    if (cameras?.type === 'cameras') this.#assembler.cameras = cameras.cameras.length;
    const picture = typeof data === 'string' ? null : this.#assembler.take(data);
    if (picture !== null) this.pictures.set(picture.camera, picture);
  }

  #onTelemetry(message: TelemetryMessage): void {
    Object.assign(this.newest, { [message.type]: message });
    if (message.type === 'reading') this.readings.set(message.topic, message);
    else if (message.type === 'telemetry') this.telemetry = message;
    else if (message.type === 'samples') this.samples.push(...message.samples);
  }

  #onPayload(payload: Buffer): void {
    this.packets++;
    const header = emptyPointPacketHeader();
    const placement = emptyPlacement();
    const view = new DataView(payload.buffer, payload.byteOffset, payload.byteLength);
    if (readCloudPayload(view, header, placement) !== null) {
      this.malformedPackets++;
      this.#waiters.changed();
      return;
    }
    this.onCloudPacket?.(payload);
    this.#hand.sees(placement.captureTimeUs);
    const { frameNumber, frameLength, sequenceLength } = header;
    const frames = this.#framesOf.get(placement.sensor) ?? new Map<number, ReceivedFrame>();
    this.#framesOf.set(placement.sensor, frames);
    const frame = frames.get(frameNumber) ?? {
      ...{ frameNumber, packets: 0, points: 0 },
      ...{ latencyTest: placement.latencyTest, complete: false },
    };
    frame.packets++;
    frame.points += pointsOfBytes(sequenceLength);
    frame.complete = frame.points === pointsOfBytes(frameLength);
    frames.set(frameNumber, frame);
    if (frames.size > 1000) frames.delete(frames.keys().next().value as number);
    this.#waiters.changed();
  }
}
