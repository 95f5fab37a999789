/** The WebRTC connection with the robot: the robot offers, the page answers, both use trickle ICE. */
import {
  CLOUD_STREAM_ID,
  channels,
  type IceCandidate,
  type IceServer,
  type MessageData,
} from '@farpoint/protocol';
import type { RobotChannel } from '../session/robot-session.ts';
import { type SoundLine, soundLineOf } from '../sound/sound-line.ts';
import { playWithoutDelay, type VideoTrack, videoOfStreams } from '../video/video-track.ts';
import { attachWorker, type TransformSupport, transformConfiguration } from './encoded-transform.ts';

export interface RobotPeerEvents {
  onAnswer(sdp: string): void;
  onCandidate(candidate: IceCandidate): void;
  /** The path is established and the robot's session channel is open. */
  onConnected(): void;
  onMessage(channel: RobotChannel, data: MessageData): void;
  /** Called before {@link onVideoTrack}, within the browser's event: a transform must be attached there. */
  onVideoReceiver?: ((receiver: RTCRtpReceiver) => void) | undefined;
  /** The robot offers a camera's video. */
  onVideoTrack(track: VideoTrack): void;
  /** The robot offers its sound. */
  onSoundLine(line: SoundLine): void;
  /** The connection ended; no event follows. Not sent after {@link RobotPeer.close}. */
  onFailed(detail: string): void;
}

export interface RobotPeerOptions {
  iceServers: readonly IceServer[];
  /** `relay`: through TURN servers only. */
  icePolicy: RTCIceTransportPolicy;
  worker: Worker;
  transform: TransformSupport;
  /** Number of the session, for the worker's batches. */
  generation: number;
}

/** Unreliable messages are dropped while more than this is queued, bytes, because they would arrive late. */
const MAX_BACKLOG = 8192;
const MAX_QUEUED_CANDIDATES = 64;

export class RobotPeer {
  readonly #events: RobotPeerEvents;
  readonly #connection: RTCPeerConnection;
  readonly #control: RTCDataChannel;
  readonly #bandwidth: RTCDataChannel;
  #session: RTCDataChannel | null = null;
  #queuedCandidates: IceCandidate[] | null = [];
  #connected = false;
  #ended = false;

  constructor(options: RobotPeerOptions, events: RobotPeerEvents) {
    this.#events = events;
    const connection = new RTCPeerConnection({
      ...iceConfiguration(options),
      bundlePolicy: 'max-bundle',
      ...transformConfiguration(options.transform),
    });
    this.#connection = connection;
    const { control, bandwidth } = channels;
    this.#control = connection.createDataChannel(control.label, {
      ordered: control.ordered,
      maxRetransmits: control.maxRetransmits,
    });
    this.#bandwidth = connection.createDataChannel(bandwidth.label, { ordered: bandwidth.ordered });
    this.#listen(this.#control, 'control');
    connection.ontrack = (event) => {
      const { streams, receiver, track } = event;
      const sound = soundLineOf(event);
      if (sound !== null && !this.#ended) {
        playWithoutDelay(receiver);
        events.onSoundLine(sound);
      }
      const ids = streams.map(({ id }) => id);
      if (track.kind === 'audio' && ids.includes(CLOUD_STREAM_ID))
        attachWorker(receiver, options.worker, options.transform, options.generation);
      const video = track.kind === 'video' ? videoOfStreams(ids) : null;
      if (video === null || this.#ended) return;
      events.onVideoReceiver?.(receiver);
      playWithoutDelay(receiver);
      events.onVideoTrack({ video, track, receiver });
    };
    connection.ondatachannel = ({ channel }) => this.#adopt(channel);
    connection.onicecandidate = ({ candidate }) => {
      if (candidate === null || this.#ended) return;
      const { candidate: text, sdpMid, sdpMLineIndex, usernameFragment } = candidate;
      events.onCandidate({ candidate: text, sdpMid, sdpMLineIndex, usernameFragment });
    };
    connection.onconnectionstatechange = () => this.#onState(connection.connectionState);
  }

  /** Used from the next offer on. */
  useIceServers(iceServers: readonly IceServer[], icePolicy: RTCIceTransportPolicy): void {
    if (this.#ended) return;
    // Repeat the whole configuration: omitted members would be reset, which is not allowed.
    const configuration = {
      ...this.#connection.getConfiguration(),
      ...iceConfiguration({ iceServers, icePolicy }),
    };
    try {
      this.#connection.setConfiguration(configuration);
    } catch (error) {
      console.warn('ICE servers stay as they were:', error);
    }
  }

  /** Answers an offer, the first or one that restarts ICE. Never throws: an unusable offer ends the connection. */
  async answer(sdp: string): Promise<void> {
    const connection = this.#connection;
    try {
      await connection.setRemoteDescription({ type: 'offer', sdp });
      await connection.setLocalDescription(await connection.createAnswer());
      const { localDescription } = connection;
      if (this.#ended || localDescription === null) return;
      this.#events.onAnswer(localDescription.sdp);
      const queued = this.#queuedCandidates ?? [];
      this.#queuedCandidates = null;
      for (const candidate of queued) await this.candidate(candidate);
    } catch (error) {
      this.#fail(`the robot's offer cannot be answered: ${String(error)}`);
    }
  }

  /** Adds a candidate. Never throws: an unusable candidate is ignored, since others may work. */
  async candidate(candidate: IceCandidate): Promise<void> {
    if (this.#ended) return;
    if (this.#queuedCandidates !== null) {
      // Candidates may overtake the offer.
      if (this.#queuedCandidates.length < MAX_QUEUED_CANDIDATES) this.#queuedCandidates.push(candidate);
      return;
    }
    const { sdpMid, sdpMLineIndex, usernameFragment } = candidate;
    await this.#connection
      .addIceCandidate({
        candidate: candidate.candidate,
        sdpMid: sdpMid ?? null,
        sdpMLineIndex: sdpMLineIndex ?? null,
        usernameFragment: usernameFragment ?? null,
      })
      .catch(() => undefined);
  }

  /** Sends unordered, without retransmission. @returns whether it was handed to the network */
  sendControl(text: string): boolean {
    if (this.#control.readyState !== 'open' || this.#control.bufferedAmount > MAX_BACKLOG) return false;
    this.#control.send(text);
    return true;
  }

  /** Sends reliably and in order. */
  sendSession(text: string): boolean {
    if (this.#session?.readyState !== 'open') return false;
    this.#session.send(text);
    return true;
  }

  sendBandwidth(bytes: Uint8Array<ArrayBuffer>): boolean {
    if (this.#bandwidth.readyState !== 'open') return false;
    this.#bandwidth.send(bytes);
    return true;
  }

  stats(): Promise<RTCStatsReport> {
    return this.#connection.getStats();
  }

  close(): void {
    this.#ended = true;
    this.#connection.close();
  }

  #adopt(channel: RTCDataChannel): void {
    if (channel.label === channels.session.label && this.#session === null) {
      this.#session = channel;
      this.#listen(channel, 'session');
      channel.onclose = () => this.#fail('the robot closed the session');
      channel.onopen = () => this.#checkConnected();
      this.#checkConnected();
    } else if (channel.label === channels.telemetry.label) {
      this.#listen(channel, 'telemetry');
    } else if (channel.label === channels.pictures.label) {
      this.#listen(channel, 'pictures');
    } else {
      channel.close();
    }
  }

  #listen(channel: RTCDataChannel, name: RobotChannel): void {
    channel.binaryType = 'arraybuffer';
    channel.onmessage = ({ data }: MessageEvent<unknown>) => {
      if (this.#ended) return;
      if (typeof data === 'string' || data instanceof ArrayBuffer) this.#events.onMessage(name, data);
    };
  }

  #onState(state: RTCPeerConnectionState): void {
    if (this.#ended) return;
    // Once connected, an ICE restart repairs a failed path; the operator requests one when it hears nothing.
    if (state === 'failed' && !this.#connected) this.#fail('no network path to the robot');
    else if (state === 'connected') this.#checkConnected();
  }

  #checkConnected(): void {
    if (this.#connected || this.#ended) return;
    if (this.#connection.connectionState !== 'connected' || this.#session?.readyState !== 'open') return;
    this.#connected = true;
    this.#events.onConnected();
  }

  #fail(detail: string): void {
    if (this.#ended) return;
    this.close();
    this.#events.onFailed(detail);
  }
}

function iceConfiguration({
  iceServers,
  icePolicy,
}: Pick<RobotPeerOptions, 'iceServers' | 'icePolicy'>): RTCConfiguration {
  return {
    iceServers: iceServers.map(({ urls, username, credential }) => ({
      urls,
      ...(username === undefined ? {} : { username }),
      ...(credential === undefined ? {} : { credential }),
    })),
    iceTransportPolicy: icePolicy,
  };
}
