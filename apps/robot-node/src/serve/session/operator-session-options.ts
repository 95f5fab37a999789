/** What a session with an operator needs to know, and what it reports. */
import type { RateController } from '@farpoint/congestion';
import type { IceCandidate, VideoCodec } from '@farpoint/protocol';
import type { CandidateRefusal } from '@farpoint/webrtc';
import type { Budgets } from '../../send/budgets/budgets.ts';
import type { CloudClaim } from '../../send/budgets/cloud-shares.ts';
import type { OperatorPeer } from '../../send/transport/operator-peer.ts';
import type { PacketLog } from '../../send/transport/packet-log.ts';
import type { OperatorPeerEvents, OperatorPeerOptions, PeerEnd } from '../../send/transport/peer-events.ts';

export interface OperatorSessionOptions {
  /** The session's handle, by which the guard also knows the operator. */
  session: string;
  operatorName: string;
  peer: OperatorPeerOptions;
  /** Makes the connection; default: over WebRTC. */
  openPeer?: ((options: OperatorPeerOptions, events: OperatorPeerEvents) => OperatorPeer) | undefined;
  /** @param transportFeedback whether the operator sends transport-wide feedback */
  makeController: (transportFeedback: boolean) => RateController;
  packetLog?: PacketLog | undefined;
  /** The largest share of the path that pictures may take, 0–1. */
  pictureShare: number;
  /** What the robot's cloud sensors claim of a path, indexed by sensor number. */
  claims: () => readonly CloudClaim[];
  /** Told when streaming starts or pauses, or when its bit rate or formats may have changed. */
  budgets: Pick<Budgets, 'update'>;
  /** What a video may use at most, bit/s without headers; 0 while it has no pictures. */
  mostVideoBitsPerSecond: (video: number, codecs: ReadonlySet<VideoCodec>) => number;
}

export interface OperatorSessionEvents {
  onCandidate(candidate: IceCandidate): void;
  onCandidateRefused(reason: CandidateRefusal, detail: string): void;
  onConnected(): void;
  /** The operator has named the formats or sensors that it reads, and may need the streams' headers. */
  onCloudFormats(): void;
  /** The operator can continue with a video only from a key frame. */
  onNeedsKeyFrame(video: number): void;
  /** A latency test's green frame was dropped; another is needed. */
  onLatencyFrameLost(): void;
  onEnded(end: PeerEnd, detail: string): void;
}
