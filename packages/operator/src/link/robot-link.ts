/** The link to the robots, either direct (webrtc-link.ts) or through a bridge (bridge/bridge-link.ts). */
import type {
  Command,
  OperatorControlMessage,
  OperatorSessionMessage,
  RobotListing,
} from '@farpoint/protocol';
import type { ChangedRobotKey } from '../access/session-admission.ts';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import type { RobotSession, RobotSessionEvents } from '../session/robot-session.ts';
import type { SessionPhase } from '../session/session-keeper.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import type { StatusFeed } from '../signaling/status-feed.ts';
import type { SoundLine } from '../sound/sound-line.ts';
import type { VideoTrack } from '../video/video-track.ts';

/** The state of the connection to the signaling service. */
export type SignalingState =
  | 'connecting'
  /** Welcomed: sessions can be opened. */
  | 'ready'
  /** Unreachable; reconnects automatically. */
  | 'waiting'
  /** The token is wrong or missing. Tries again slowly, in case the service's configuration is wrong. */
  | 'refused'
  | 'stopped';

/** What a {@link RobotLink} reports, besides what the robot sends. */
export interface RobotLinkEvents extends RobotSessionEvents {
  /** The connection to the signaling service has changed its state. */
  onSignaling(state: SignalingState): void;
  /** The service lists these robots now. */
  onRobots(robots: readonly RobotListing[]): void;
  /** The session is in this phase now. */
  onPhase(phase: SessionPhase): void;
  /** The session was given up. */
  onLoss(loss: SessionLoss): void;
  /** Within a session: nothing is received (`false`), or something is again (`true`). */
  onPath(up: boolean): void;
  /** A peer connection is being set up; its batches have this generation. */
  onGeneration(generation: number): void;
  /** The robot offers a camera's video, in the session that is being set up or that there is. */
  onVideoTrack(track: VideoTrack): void;
  /** The robot offers its sound, likewise. */
  onSoundLine(line: SoundLine): void;
  /** The service refused a request; the text is the service's. */
  onRefusal(message: string): void;
}

/** The link to the robots, by WebRTC or through a bridge. {@link RobotClient} creates and owns it. */
export interface RobotLink {
  /** The phase of the session with the wanted robot. */
  readonly phase: SessionPhase;
  /** The state of the connection to the signaling service. */
  readonly signaling: SignalingState;
  /** Where operators sign in for a grant; `null` if the signaling service has named no place. */
  readonly signInUrl: string | null;
  /** The robots that the service lists now. */
  readonly robots: readonly RobotListing[];
  /** What the listed robots say about themselves, while it is watched. */
  readonly statusFeed: StatusFeed;
  /** The wanted robot; `null` if none is wanted. */
  readonly robotId: string | null;
  /** Whether the service lists the wanted robot. */
  readonly robotListed: boolean;
  /** What the robot has sent in this session. */
  readonly session: RobotSession;
  /** Whether nothing is being received within a session. */
  readonly interrupted: boolean;
  /** Number of sessions opened since the link was created. */
  readonly sessionsOpened: number;
  /** Why the last session was given up; `null` if none was. */
  readonly lastLoss: SessionLoss | null;
  /** What was said about it, for people; `null` if nothing was. */
  readonly lossDetail: string | null;
  /** After the loss `robot-key-changed`: the keys; otherwise `null`. */
  readonly changedRobotKey: ChangedRobotKey | null;
  /** How many operators the robot accepts, if it has said that it is full. */
  readonly maxOperators: number | null;
  /** Connects to the signaling service or bridge, and stays connected. */
  start(): void;
  /** Ends the session and frees everything. */
  close(): void;
  /** Opens a session with this robot as soon as it is listed, and again whenever it is lost. */
  connect(robotId: string): void;
  /** Tries again now, also after a loss that is final: `not-granted`, `robot-key-changed` and `robot-unproven`. */
  retry(): void;
  /** Ends the session and wants no robot. */
  disconnect(): void;
  /** Time since anything was last received, ms. */
  silentMs(nowMs: number): number;
  /** Sends a command, unordered and never repeated; it is lost while the path is. */
  sendCommand(command: Command): void;
  /** Sends a message, unordered and never repeated, also while the path is lost. No effect through a bridge. */
  sendControl(message: OperatorControlMessage): void;
  /** Sends a message, in order and reliably; without a session it is lost. */
  sendSession(message: OperatorSessionMessage): void;
  /** Asks the robot to send at most this rate, bit/s. No effect through a bridge. */
  limitBandwidth(bitsPerSecond: number): void;
  /** Points were received. */
  onPoints(nowMs: number): void;
  /** Reports to the robot what has arrived. No effect through a bridge. */
  sendReport(report: IntakeReport): void;
}
