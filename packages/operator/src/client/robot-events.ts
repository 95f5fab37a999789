import type {
  Alarm,
  Cameras,
  CommandRejected,
  Diagnostics,
  EstopState,
  Handover,
  LeaseState,
  MapTiles,
  NearField,
  Operators,
  PlannedPath,
  Pointed,
  Quantity,
  Reading,
  RobotListing,
  Samples,
  SensorRings,
  Sensors,
  Sound,
  Telemetry,
  Videos,
  Welcome,
} from '@farpoint/protocol';
import type { Batch } from '../cloud/batch.ts';
import type { CommandEnd, RobotCommands } from '../commands/robot-commands.ts';
import type { DriveInput } from '../drive/drive-input.ts';
import type { GripLoss } from '../drive/grips.ts';
import type { LatencyResult } from '../latency/latency-test.ts';
import type { SignalingState } from '../link/robot-link.ts';
import type { Picture } from '../pictures/picture-feed.ts';
import type { SessionPhase } from '../session/session-keeper.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import type { VoiceStatus } from '../sound/robot-sound.ts';
import type { StopStatus } from '../stop/stop-delivery.ts';
import type { VideoTrack } from '../video/video-track.ts';

/** Why the client cannot work at all. */
export type ClientFailure = 'cloud-worker';

/** The event types of {@link RobotClient.on}, and the arguments of their listeners. */
export interface RobotEvents {
  /** The state of the connection to the signaling service. */
  signaling: SignalingState;
  /** The robots that the service lists, whenever the list changes. */
  robots: readonly RobotListing[];
  /** The phase of the session with the chosen robot. */
  phase: SessionPhase;
  /** A new session begins: whatever was received before belongs to an earlier one. */
  session: number;
  /** Within a session: the network path is lost (`false`) or restored (`true`). */
  path: boolean;
  /** A session was given up. The client opens another automatically, unless a supervisor ended this one. */
  loss: SessionLoss;
  /** The signaling service refused a request; the text is the service's. */
  refused: string;
  /** The robot's first message: its name, its drive limits. */
  welcome: Welcome;
  /** The operator's grant ends in so many seconds, and the session with it. Comes a minute before. */
  grantExpires: number;
  /** Who drives. */
  lease: LeaseState;
  /** Who has a session with the robot, and who of them drives. */
  operators: Operators;
  /**
   * A request for the drive or an offer of it that this operator has made or is to answer ({@link RobotClient.people}), or
   * what has become of it.
   */
  handover: Handover;
  /** The robot's commands besides driving, what runs of them, or its recording has changed. */
  commands: RobotCommands;
  /** What has become of one of these commands: of each that ended, and of those of this operator that were refused. */
  commandEnd: CommandEnd;
  /** Another operator points at a spot ({@link RobotClient.people}). */
  pointed: Pointed;
  /** The robot refused a command. */
  commandRejected: CommandRejected;
  /** The emergency stop, latched or released. */
  estop: EstopState;
  /** What has become of {@link RobotClient.estop}. */
  stop: StopStatus;
  /** The grip was pressed, but another operator drives. */
  otherDrives: undefined;
  /** A stick or key of this device is pushed, but its grip is open: the robot does not move. Comes once for each push. */
  gripMissing: DriveInput['name'];
  /** A grip that was held counts as released until it has been opened. */
  gripLost: GripLoss;
  /** Pose, velocity, drive state, battery; 20 times a second. */
  telemetry: Telemetry;
  /** A reading of one of the robot's sensors or topics. */
  reading: Reading;
  /** Describes a number that the robot measures over time; after the welcome, one event for each. */
  quantity: Quantity;
  /** Samples of these numbers. The channel is unordered, so they may come late. */
  samples: Samples;
  /** What stands around the robot. `link.session.near` has the newest, and its age. */
  nearField: NearField;
  /** The robot's own navigator has planned another path. `link.session.plannedPath` has the newest, and its age. */
  plannedPath: PlannedPath;
  /** Tiles of the robot's map of which something is new. `link.session.map` has the whole. */
  map: MapTiles;
  /** What some of the robot's components report about themselves. `link.session.components` has all of them. */
  diagnostics: Diagnostics;
  /** An alarm was raised, changed its level or was cleared. `link.session.alarms` has those that are raised. */
  alarm: Alarm;
  /** The cameras that {@link RobotClient.watch} can be called with. */
  cameras: Cameras['cameras'];
  /** The sensors that {@link RobotClient.wantClouds} can be called with; sent by robots that have more than one. */
  sensors: Sensors['sensors'];
  /** The rings of a spinning LiDAR among the sensors, from robots that know them; again when they change. */
  rings: SensorRings;
  /**
   * The cameras that {@link RobotClient.watchVideos} can be called with. Comes again, with the same cameras in the same
   * order, when a camera's video stops or returns: then its `fault` appears or disappears.
   */
  videos: Videos['videos'];
  /** The track of a listed video, after the `videos` event. It is silent until the video is watched. */
  videoTrack: VideoTrack;
  /**
   * The robot's microphone, and whether the robot hears this operator; from robots that have sound, after the welcome and
   * at every change.
   */
  sound: Sound;
  /** The track of the robot's microphone. It is silent unless {@link RobotSound.listen} was called. */
  soundTrack: MediaStreamTrack;
  /** The operator's own voice has changed: see {@link RobotSound.press}. */
  voice: VoiceStatus;
  /** A picture of a watched camera. */
  picture: Picture;
  /** A picture of this camera could not be decoded. */
  pictureFault: {
    /** Index in the list of the `cameras` event. */
    camera: number;
    /** For people: what is wrong. */
    detail: string;
  };
  /**
   * Decoded points of the first sensor, each packet with the pose of its frame. The listener must return the batch with
   * {@link RobotClient.release}, because the number of batches is limited. Register at most one listener.
   */
  cloud: Batch;
  /** Decoded points of a sensor other than the first, with its number. */
  [cloud: `cloud:${number}`]: Batch;
  /** A latency test ended. */
  latency: LatencyResult;
  /** The robot could not use a message from this client; the text is the robot's. */
  robotFault: string;
  /** The client cannot work in this browser or with this server. */
  failed: {
    /** What failed, for programs. */
    reason: ClientFailure;
    /** For people: what is wrong. */
    detail: string;
  };
}
