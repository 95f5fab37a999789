import type { KnownRobots } from '../access/known-robots.ts';
import type { OperatorCredentials } from '../access/operator-credentials.ts';
import type { TransformSupport } from '../peer/encoded-transform.ts';

export interface WebRtcLinkOptions {
  signalingUrl: string;
  name: string;
  token: string | undefined;
  credentials?: (() => Promise<readonly OperatorCredentials[]>) | undefined;
  knownRobots: KnownRobots;
  worker: Worker;
  transform: TransformSupport;
  /** `relay`: through TURN servers only. */
  icePolicy: RTCIceTransportPolicy;
  onVideoReceiver?: (receiver: RTCRtpReceiver) => void;
}
