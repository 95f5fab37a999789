import type { IceCandidate, IceServer, VideoCodec } from '@farpoint/protocol';
import type { CandidateRefusal, Refusal } from '@farpoint/webrtc';
import type { VideoRefusal } from './answered-codecs.ts';
import type { RtpTransport } from './rtp-transport.ts';
import type { SrtpTransport } from './srtp-transport.ts';
import type { VoiceReceiver } from './voice-receiver.ts';

/** A video's m-line, as it was negotiated with one operator. */
export interface VideoLine {
  /** `a=mid`. */
  mid: string;
  /** `null` if the operator refused the line, for example because it cannot decode any of the codecs. */
  transport: SrtpTransport | null;
  /** The payload type of each codec that the operator decodes; empty if it refused the line. */
  payloadTypes: ReadonlyMap<VideoCodec, number>;
  /** Why there is no transport; `null` if there is one. */
  refusal: VideoRefusal | null;
}

/** The m-line for sound, as it was negotiated with one operator. */
export interface SoundLine {
  /** `a=mid`. */
  mid: string;
  /** The robot's microphone; `null` if the operator refused the line. */
  transport: (RtpTransport & { sendReport(nowMs: number, clockRate: number): void }) | null;
  /** The operator's voice; `null` if the operator refused the line. */
  voice: VoiceReceiver | null;
}

/** Why a connection ended. */
export type PeerEnd =
  | 'closed' // by us
  | 'bad-answer' // the operator's SDP or its codecs cannot be used
  | 'not-granted' // the operator has no grant that is valid for this robot
  | 'grant-expired'
  | 'grant-revoked'
  | 'ended-by-supervisor'
  | 'robot-full' // there is no place for it, or no longer
  | 'unproven-peer' // DTLS: another certificate than the answer names, or a key that it does not have
  | 'not-connected' // no connection came about
  | 'connection-lost' // ICE, DTLS or a channel ended
  | 'silent' // nothing heard for too long
  | 'not-reading'; // our reliable messages pile up

const UNINTENDED: ReadonlySet<PeerEnd> = new Set([
  'connection-lost',
  'silent',
  'not-reading',
  'not-connected',
]);

/** Nobody has said that this end is meant: the same person is likely to come back. */
export function isUnintended(end: PeerEnd): boolean {
  return UNINTENDED.has(end);
}

export interface OperatorPeerOptions {
  iceServers: readonly IceServer[];
  /** Local UDP ports, both ends included; any port if undefined. */
  portRange?: readonly [number, number] | undefined;
  /** `relay`: through TURN servers only. */
  icePolicy?: 'all' | 'relay' | undefined;
  connectTimeoutMs: number;
  /** Whether to open a channel for pictures. */
  pictures?: boolean | undefined;
  /** The codecs of each video to offer, in the order of preference; none if undefined. */
  videos?: readonly (readonly VideoCodec[])[] | undefined;
  /** Whether to offer an m-line for sound. */
  sound?: boolean | undefined;
  /** Called when something from the network was dropped unread. */
  onRefused?: ((reason: Refusal) => void) | undefined;
}

export interface OperatorPeerEvents {
  onCandidate(candidate: IceCandidate): void;
  /** A candidate of the operator is left out; others may work. */
  onCandidateRefused?(reason: CandidateRefusal, detail: string): void;
  /**
   * The path and our channels are up.
   *
   * @param sound `null` if none was offered
   */
  onConnected(clouds: RtpTransport, videos: readonly VideoLine[], sound: SoundLine | null): void;
  onMessage(channel: 'session' | 'control' | 'bandwidth', data: string | Uint8Array): void;
  /** Whether the operator drives now, so that more is taken from it. */
  drives?(): boolean;
  /** Almost all queued picture data has been sent. */
  onPicturesLow?(): void;
  /** The last event. `detail` is for people. */
  onEnded(end: PeerEnd, detail: string): void;
}
