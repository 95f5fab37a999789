/** The link to the robots, whichever way it goes: directly (webrtc-link.ts) or through a bridge (bridge/bridge-link.ts). */
import type { Command, OperatorSessionMessage, RobotListing } from '@farpoint/protocol';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import type { RobotSession, RobotSessionEvents } from '../session/robot-session.ts';
import type { SessionPhase } from '../session/session-keeper.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import type { SignalingState } from '../signaling/signaling-state.ts';

export interface RobotLinkEvents extends RobotSessionEvents {
  onSignaling(state: SignalingState): void;
  onRobots(robots: readonly RobotListing[]): void;
  onPhase(phase: SessionPhase): void;
  onLoss(loss: SessionLoss): void;
  /** Within a session: nothing comes through (`false`), or something does again. */
  onPath(up: boolean): void;
  /** A peer connection is being made: batches of this generation are its own. */
  onGeneration(generation: number): void;
  /** The service refused something, in its own words. */
  onRefusal(message: string): void;
}

/** The way to the robots: by WebRTC, or through a bridge. {@link RobotClient} makes one and keeps it. */
export interface RobotLink {
  /** Where the session with the wanted robot stands. */
  readonly phase: SessionPhase;
  /** The connection to the signaling service. */
  readonly signaling: SignalingState;
  /** The robots that the service lists now. */
  readonly robots: readonly RobotListing[];
  /** The wanted robot; `null` where none is wanted. */
  readonly robotId: string | null;
  /** Whether the service lists the wanted robot. */
  readonly robotListed: boolean;
  /** What the robot has told in this session. */
  readonly session: RobotSession;
  /** Within a session, nothing comes through. */
  readonly interrupted: boolean;
  /** Sessions opened since the link was made. */
  readonly sessionsOpened: number;
  /** Why the last session was given up; `null` where none was. */
  readonly lastLoss: SessionLoss | null;
  /** How many operators the robot takes, where it has said that it is full. */
  readonly maxOperators: number | null;
  /** Connects to the signaling service or bridge, and stays connected. */
  start(): void;
  /** Ends the session, and everything with it. */
  close(): void;
  /** Opens a session with this robot as soon as it is listed, and again whenever it is lost. */
  connect(robotId: string): void;
  /** Ends the session and wants no robot. */
  disconnect(): void;
  /** Since anything was last heard, ms. */
  silentMs(nowMs: number): number;
  /** Sends a command, unordered and never repeated; it is lost while nothing comes through. */
  sendCommand(command: Command): void;
  /** Sends a message, in order and reliably; without a session it is lost. */
  sendSession(message: OperatorSessionMessage): void;
  /** Asks the robot to send no more than this, bit/s; through a bridge it does nothing. */
  limitBandwidth(bitsPerSecond: number): void;
  /** Points came. */
  onPoints(nowMs: number): void;
  /** Tells the robot what has arrived; through a bridge it does nothing. */
  sendReport(report: IntakeReport): void;
}
