/** The WebRTC connection with Janus: it offers what the robot feeds it with, the page answers. */
import type { JanusCandidate } from '@farpoint/janus';
import type { Broadcast } from '@farpoint/protocol';
import { attachWorker, type TransformSupport, transformConfiguration } from '../peer/encoded-transform.ts';
import { playWithoutDelay, type VideoTrack } from '../video/video-track.ts';
import type { StampOptions, ToStampWorker } from './stamp-messages.ts';

export interface WatchPeerOptions {
  broadcast: Broadcast;
  iceServers: readonly RTCIceServer[];
  transform: TransformSupport;
  cloudWorker: Worker;
  stampWorker: Worker;
  generation: number;
}

export interface WatchPeerEvents {
  /** A candidate of ours; `null`: there are no more. */
  onCandidate(candidate: RTCIceCandidate | null): void;
  onVideoTrack(track: VideoTrack): void;
  onConnected(): void;
  onFailed(detail: string): void;
}

interface EncodedStreamsReceiver extends RTCRtpReceiver {
  createEncodedStreams(): { readable: ReadableStream; writable: WritableStream };
}

export class WatchPeer {
  readonly #options: WatchPeerOptions;
  readonly #events: WatchPeerEvents;
  readonly #connection: RTCPeerConnection;
  #early: JanusCandidate[] | null = [];
  #ended = false;

  constructor(options: WatchPeerOptions, events: WatchPeerEvents) {
    this.#options = options;
    this.#events = events;
    const connection = new RTCPeerConnection({
      iceServers: [...options.iceServers],
      bundlePolicy: 'max-bundle',
      ...transformConfiguration(options.transform),
    });
    this.#connection = connection;
    connection.ontrack = (event) => this.#onTrack(event);
    connection.onicecandidate = ({ candidate }) => {
      if (!this.#ended) events.onCandidate(candidate);
    };
    connection.onconnectionstatechange = () => {
      if (this.#ended) return;
      const { connectionState } = connection;
      if (connectionState === 'connected') events.onConnected();
      else if (connectionState === 'failed') events.onFailed('no network path to the relay');
    };
  }

  /** Answers the offer. @throws {DOMException} if it cannot be used */
  async answer(sdp: string): Promise<string> {
    const connection = this.#connection;
    await connection.setRemoteDescription({ type: 'offer', sdp: separateStreams(sdp) });
    await connection.setLocalDescription(await connection.createAnswer());
    const early = this.#early ?? [];
    this.#early = null;
    for (const candidate of early) await this.candidate(candidate);
    return connection.localDescription?.sdp ?? '';
  }

  /** Never throws: an unusable candidate is ignored, since others may work. */
  async candidate(candidate: JanusCandidate): Promise<void> {
    if (this.#ended || !('candidate' in candidate)) return;
    if (this.#early !== null) {
      this.#early.push(candidate);
      return;
    }
    const { sdpMid = null, sdpMLineIndex = null } = candidate;
    await this.#connection
      .addIceCandidate({ candidate: candidate.candidate, sdpMid, sdpMLineIndex })
      .catch(() => undefined);
  }

  close(): void {
    this.#ended = true;
    this.#connection.close();
  }

  /** The transforms must be attached at once, or the first frames are lost. */
  #onTrack({ transceiver, receiver, track }: RTCTrackEvent): void {
    const { broadcast, cloudWorker, transform, generation } = this.#options;
    const { mid } = transceiver;
    if (track.kind === 'audio') {
      if (mid === broadcast.clouds?.mid) attachWorker(receiver, cloudWorker, transform, generation);
      return;
    }
    const video = broadcast.videos.findIndex((each) => each.mid === mid);
    const codec = broadcast.videos[video]?.codec;
    if (codec === undefined) return;
    this.#readStamps(receiver, { generation, video, codec });
    playWithoutDelay(receiver);
    this.#events.onVideoTrack({ video, track, receiver });
  }

  #readStamps(receiver: RTCRtpReceiver, options: StampOptions): void {
    const { stampWorker, transform } = this.#options;
    if (transform === 'script-transform')
      receiver.transform = new RTCRtpScriptTransform(stampWorker, options);
    else if (transform === 'encoded-streams') {
      const { readable, writable } = (receiver as EncodedStreamsReceiver).createEncodedStreams();
      const message: ToStampWorker = { ...options, readable, writable };
      stampWorker.postMessage(message, [readable, writable]);
    }
  }
}

/**
 * Gives each track of Janus' offer a stream of its own. Janus puts all into one, and a browser delays the tracks of one
 * stream to play them in step, by rules of its own.
 */
export function separateStreams(sdp: string): string {
  return sdp.replaceAll(/^a=msid:\S+ (\S+)/gm, 'a=msid:farpoint-$1 $1');
}
