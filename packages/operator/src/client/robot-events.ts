import type {
  Cameras,
  CommandRejected,
  EstopState,
  LeaseState,
  Reading,
  RobotListing,
  Sensors,
  Telemetry,
  Welcome,
} from '@farpoint/protocol';
import type { Batch } from '../cloud/batch.ts';
import type { LatencyResult } from '../latency/latency-test.ts';
import type { Picture } from '../pictures/picture-feed.ts';
import type { SessionPhase } from '../session/session-keeper.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import type { SignalingState } from '../signaling/signaling-state.ts';

/** Why the client cannot work at all. */
export type ClientFailure = 'cloud-worker';

/** What {@link RobotClient.on} can be asked for, and what its listeners are called with. */
export interface RobotEvents {
  /** The connection to the signaling service. */
  signaling: SignalingState;
  /** The robots that the service lists, whenever the list changes. */
  robots: readonly RobotListing[];
  /** Where the session with the chosen robot stands. */
  phase: SessionPhase;
  /** A new session begins: what was received before is of another one. */
  session: number;
  /** Within a session: the network path is lost (`false`), or carries again. */
  path: boolean;
  /** A session was given up. The client opens another one by itself. */
  loss: SessionLoss;
  /** The signaling service refused a request, in its own words. */
  refused: string;
  /** The robot's first message: its name, its drive limits. */
  welcome: Welcome;
  /** Who drives. */
  lease: LeaseState;
  /** The robot refused a command. */
  commandRejected: CommandRejected;
  /** The emergency stop, latched or released. */
  estop: EstopState;
  /** The grip was taken, but another operator drives. */
  otherDrives: undefined;
  /** Pose, velocity, drive state, battery; 20 times a second. */
  telemetry: Telemetry;
  /** What a sensor or topic of the robot says. */
  reading: Reading;
  /** The cameras that {@link RobotClient.watch} can be called with. */
  cameras: Cameras['cameras'];
  /** The sensors that {@link RobotClient.wantClouds} can be called with; of a robot that has more than one. */
  sensors: Sensors['sensors'];
  /** A picture of a camera that is watched. */
  picture: Picture;
  /** A file of this camera that cannot be decoded. */
  pictureFault: {
    /** Index in the list of the `cameras` event. */
    camera: number;
    /** For people: what is wrong. */
    detail: string;
  };
  /**
   * Decoded points of the first sensor, each packet with the pose of its frame. Whoever takes the batch gives it back by
   * {@link RobotClient.release}: there is a bounded number of them. Register at most one listener that takes batches.
   */
  cloud: Batch;
  /** The same of sensors other than the first, by number. */
  [cloud: `cloud:${number}`]: Batch;
  /** A latency test ended. */
  latency: LatencyResult;
  /** The robot could not use a message of ours, in its own words. */
  robotFault: string;
  /** The client cannot work in this browser or with this server. */
  failed: {
    /** What failed, for programs. */
    reason: ClientFailure;
    /** For people: what is wrong. */
    detail: string;
  };
}
