/** A viewer for tests and benchmarks: a werift peer that watches a mountpoint as a browser would. */

import { JanusFailure, StreamingClient } from '@farpoint/janus';
import {
  type Broadcast,
  broadcastCodec,
  decodeJson,
  emptyPlacement,
  emptyPointPacketHeader,
  readCaptureStamp,
  readCloudPayload,
} from '@farpoint/protocol';
import { VideoDepacketiser } from '@farpoint/rtp';
import { Waiters } from '@farpoint/service/testing/waiters';
import {
  type MediaStreamTrack,
  RTCPeerConnection,
  RTCRtpCodecParameters,
  useNACK,
  usePLI,
  useSdesMid,
} from 'werift';
import { WebSocket } from 'ws';

/** What a viewer has seen of one video. */
export interface SeenVideo {
  frames: number;
  keyFrames: number;
  /** Of each whole frame, the robot's clock, ns; `null` where it was not stamped. The last 1,000. */
  readonly captureNs: (bigint | null)[];
  /** RTP timestamps as the relay has rewritten them, of the same frames. */
  readonly timestamps: number[];
}

export interface JanusViewerOptions {
  url: string;
  mountpoint: number;
  pin?: string | undefined;
  /** Count packets only: the cheapest viewer. */
  light?: boolean | undefined;
}

const KEPT = 1000;

export class JanusViewer {
  readonly videos = new Map<string, SeenVideo>();
  /** By sensor and frame number: how many packets of a cloud came. */
  readonly clouds = new Map<string, { captureTimeUs: number; packets: number }>();
  packets = 0;
  malformedPackets = 0;
  /** Why it was refused, or how it ended. */
  ended: string | null = null;
  broadcast: Broadcast | null = null;
  readonly #options: JanusViewerOptions;
  readonly #connection: RTCPeerConnection;
  readonly #waiters = new Waiters();
  #client: StreamingClient | null = null;

  private constructor(options: JanusViewerOptions) {
    this.#options = options;
    const feedback = { rtcpFeedback: [useNACK(), usePLI()] };
    this.#connection = new RTCPeerConnection({
      iceServers: [],
      bundlePolicy: 'max-bundle',
      codecs: {
        audio: [new RTCRtpCodecParameters({ mimeType: 'audio/opus', clockRate: 48_000, channels: 2 })],
        video: ['VP8', 'H264'].map(
          (codec) =>
            new RTCRtpCodecParameters({ mimeType: `video/${codec}`, clockRate: 90_000, ...feedback }),
        ),
      },
      headerExtensions: { audio: [useSdesMid()], video: [useSdesMid()] },
    });
    this.#connection.onTrack.subscribe((track) => this.#onTrack(track));
  }

  /** Asks to watch; what comes of it is told by {@link until}. @throws {JanusFailure} if Janus is out of reach */
  static async watch(options: JanusViewerOptions): Promise<JanusViewer> {
    const viewer = new JanusViewer(options);
    await viewer.#watch();
    return viewer;
  }

  /** Resolves once the condition holds. */
  until(holds: () => boolean): Promise<void> {
    return this.#waiters.until(holds);
  }

  /** Asks for a key frame of each video, as a decoder does that has lost its picture. */
  async losePicture(): Promise<void> {
    for (const { receiver } of this.#connection.getTransceivers())
      for (const { track } of receiver.tracks.map((each) => ({ track: each })))
        if (track.kind === 'video' && track.ssrc !== undefined) await receiver.sendRtcpPLI(track.ssrc);
  }

  async close(): Promise<void> {
    this.#client?.close();
    await this.#connection.close();
  }

  async #watch(): Promise<void> {
    const { url, mountpoint, pin = null } = this.#options;
    const client = await StreamingClient.connect(
      { open: () => new WebSocket(url, 'janus-protocol') },
      {
        onEvent: (event, jsep) => {
          if ('error' in event) this.#end(event.error);
          else if ('metadata' in event) this.#describe(event.metadata);
          else if (event.result.status === 'stopped') this.#end('stopped');
          if (jsep !== undefined) void this.#answer(client, jsep.sdp);
        },
        onCandidate: (candidate) => {
          if ('candidate' in candidate)
            void this.#connection
              .addIceCandidate({
                candidate: candidate.candidate,
                ...{ sdpMid: candidate.sdpMid ?? null, sdpMLineIndex: candidate.sdpMLineIndex ?? null },
              })
              .catch(() => undefined);
        },
        onHangup: (reason) => this.#end(reason),
        onClosed: (failure) => this.#end(failure.message),
      },
    );
    this.#client = client;
    this.#connection.onIceCandidate.subscribe((candidate) => {
      if (candidate === undefined) client.trickle(null);
      else {
        const { candidate: text, sdpMid, sdpMLineIndex } = candidate.toJSON();
        client.trickle({ candidate: text, sdpMid: sdpMid ?? null, sdpMLineIndex: sdpMLineIndex ?? null });
      }
    });
    const { metadata } = await client.info(mountpoint);
    this.#describe(metadata ?? '');
    await client.watch(mountpoint, pin);
  }

  async #answer(client: StreamingClient, sdp: string): Promise<void> {
    try {
      await this.#connection.setRemoteDescription({ type: 'offer', sdp });
      await this.#connection.setLocalDescription(await this.#connection.createAnswer());
      await client.start({ type: 'answer', sdp: this.#connection.localDescription?.sdp ?? '' });
    } catch (error) {
      if (!(error instanceof JanusFailure)) throw error;
      this.#end(error.message);
    }
  }

  #describe(metadata: string): void {
    this.broadcast = decodeJson(broadcastCodec, metadata);
    this.#waiters.changed();
  }

  #end(reason: string): void {
    this.ended ??= reason;
    this.#waiters.changed();
  }

  #onTrack(track: MediaStreamTrack): void {
    if (track.kind === 'video') this.#onVideo(track);
    else
      track.onReceiveRtp.subscribe(({ payload }) => {
        this.packets++;
        if (this.#options.light !== true) this.#onCloud(payload);
        this.#waiters.changed();
      });
  }

  #onVideo(track: MediaStreamTrack): void {
    const transceiver = this.#connection.getTransceivers().find(({ receiver }) => receiver.track === track);
    const codec = track.codec?.name.toUpperCase() === 'H264' ? 'H264' : 'VP8';
    const depacketiser = new VideoDepacketiser(codec === 'H264' ? 'h264' : 'vp8');
    const seen: SeenVideo = { frames: 0, keyFrames: 0, captureNs: [], timestamps: [] };
    this.videos.set(transceiver?.mid ?? '', seen);
    track.onReceiveRtp.subscribe(({ header, payload }) => {
      this.packets++;
      if (this.#options.light === true) {
        if (header.marker) seen.frames++;
      } else {
        const { sequenceNumber, timestamp, marker } = header;
        const frame = depacketiser.take(sequenceNumber, timestamp, marker, payload);
        if (frame !== null) {
          seen.frames++;
          if (frame.isKeyFrame) seen.keyFrames++;
          seen.captureNs.push(readCaptureStamp(frame.bytes, codec));
          seen.timestamps.push(timestamp);
          if (seen.captureNs.length > KEPT) seen.captureNs.shift();
          if (seen.timestamps.length > KEPT) seen.timestamps.shift();
        }
      }
      this.#waiters.changed();
    });
  }

  #onCloud(payload: Buffer): void {
    const header = emptyPointPacketHeader();
    const placement = emptyPlacement();
    const view = new DataView(payload.buffer, payload.byteOffset, payload.byteLength);
    if (readCloudPayload(view, header, placement) !== null) {
      this.malformedPackets++;
      return;
    }
    const key = `${placement.sensor} ${header.frameNumber}`;
    const cloud = this.clouds.get(key) ?? { captureTimeUs: placement.captureTimeUs, packets: 0 };
    cloud.packets++;
    this.clouds.set(key, cloud);
    const [oldest] = this.clouds.keys();
    if (this.clouds.size > KEPT && oldest !== undefined) this.clouds.delete(oldest);
  }
}
