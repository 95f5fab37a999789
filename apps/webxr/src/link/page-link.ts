/** The page's link to its robots, whichever way it goes: directly (robot-link.ts) or by a bridge (bridge/bridge-link.ts). */
import type { Command, OperatorSessionMessage, RobotListing } from '@farpoint/protocol';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import type { RobotSession } from '../session/robot-session.ts';
import type { SessionPhase } from '../session/session-keeper.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import type { SignalingState } from '../signaling/operator-signaling.ts';

export interface PageLink {
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
