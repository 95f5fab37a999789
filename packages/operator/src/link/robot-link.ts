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

export interface RobotLink {
  readonly phase: SessionPhase;
  readonly signaling: SignalingState;
  readonly robots: readonly RobotListing[];
  /** The wanted robot. */
  readonly robotId: string | null;
  readonly robotListed: boolean;
  /** What the robot has told in this session. */
  readonly session: RobotSession;
  /** Within a session, nothing comes through. */
  readonly interrupted: boolean;
  readonly sessionsOpened: number;
  readonly lastLoss: SessionLoss | null;
  /** How many operators the robot takes, where it has said that it is full. */
  readonly maxOperators: number | null;
  start(): void;
  /** Ends the session, and everything with it. */
  close(): void;
  connect(robotId: string): void;
  disconnect(): void;
  /** Since anything was last heard, ms. */
  silentMs(nowMs: number): number;
  sendCommand(command: Command): void;
  sendSession(message: OperatorSessionMessage): void;
  limitBandwidth(bitsPerSecond: number): void;
  /** Points came. */
  onPoints(nowMs: number): void;
  sendReport(report: IntakeReport): void;
}
