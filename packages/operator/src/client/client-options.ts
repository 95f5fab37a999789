import type { CloudFormat } from '@farpoint/protocol';
import type { KnownRobots } from '../access/known-robots.ts';
import type { OperatorCredentials } from '../access/operator-credentials.ts';
import type { BridgeAddress } from '../bridge/bridge-settings.ts';
import type { DriveInput } from '../drive/drive-input.ts';
import type { RobotLink, RobotLinkEvents } from '../link/robot-link.ts';
import type { TransformSupport } from '../peer/encoded-transform.ts';

/** What a {@link RobotClient} is made with. {@link connect} fills it in for most pages. */
export interface RobotClientOptions {
  /** WebSocket address of the signaling service's endpoint for operators. */
  signalingUrl: string;
  /** The name by which other operators and the robot's log know this one. */
  name: string;
  /** The operator's token, if the service requires one. */
  token: string | undefined;
  /** The operator's grants, for robots that ask for them; called before each session is answered. */
  credentials?: (() => Promise<readonly OperatorCredentials[]>) | undefined;
  /** The keys by which robots are recognised. Default: those that are seen first, until the client is closed. */
  knownRobots?: KnownRobots | undefined;
  /** `relay`: through TURN servers only. */
  icePolicy: RTCIceTransportPolicy;
  /** How this browser hands encoded frames to a worker. */
  transform: TransformSupport;
  /** Takes the stream from a bridge instead of directly from the robots. */
  bridge?: BridgeAddress | null;
  /**
   * Makes the link instead of the library: for a transport of one's own, and for tests. The client owns the link that it
   * returns. `worker` decodes clouds.
   */
  openLink?: ((worker: Worker, events: RobotLinkEvents) => RobotLink) | undefined;
  /** The cloud formats that the robot may choose from; default: all. */
  cloudFormats?: readonly CloudFormat[] | undefined;
  /**
   * Called when the browser has made the receiver of a robot's video, long before the `videoTrack` event: the only moment
   * at which it can be given a `transform`.
   */
  onVideoReceiver?: (receiver: RTCRtpReceiver) => void;
  /** Devices that drive, besides {@link RobotClient.drive}. The first whose grip is held drives. */
  inputs?: readonly DriveInput[];
}
