/** What a session with an operator asks of the robot, and of its connection. */
import type {
  Command,
  CommandAnswer,
  EstopCause,
  GoalReason,
  GoalRequest,
  LatencyMeasured,
  ProtocolError,
} from '@farpoint/protocol';
import type { CommandVerdict, RejectedCommand } from '@farpoint/safety';
import type { Access } from '../access/access.ts';
import type { LeaseCause } from '../audit/robot-audit.ts';
import type { DriveStation } from '../drive/drive-station.ts';
import type { CommandStation } from '../robot-commands/command-station.ts';
import type { RatedMessage } from './message-rates.ts';

/** The operator of a session. */
export interface SessionOperator {
  readonly id: string;
  readonly access: Access;
  readonly operatorName: string;
  /** When a message last came from it, ms on the robot's clock. */
  readonly heardMs: number;
}

/** Sends a session's messages to its operator. */
export interface SessionLink {
  sendSession(text: string): void;
  sendControl(text: string): void;
}

/** What a session needs from the robot. */
export interface SessionHost {
  readonly drive: DriveStation;
  /** The robot's commands; `null` or undefined if it takes none. */
  readonly commands?: CommandStation | null;
  now(): number;
  /** The driver has changed, and all operators must be told. @param cause if it was not a request */
  leaseChanged(cause?: LeaseCause): void;
  /** The emergency stop was latched or released. @param by who changed it; undefined: the robot itself */
  estopChanged(by?: SessionOperator): void;
  /** It was latched again: all operators must be told its new number. */
  estopRenewed(by: SessionOperator): void;
  latencyTestRequested(session: SessionOperator, id: number, commandMs: number): void;
  /** For the counters. */
  commandAccepted(): void;
  commandRejected(rejection: RejectedCommand): void;
  /** For a recording: each command, and the guard's verdict. */
  commandJudged?(session: SessionOperator, command: Command, verdict: CommandVerdict): void;
  /** For a recording: what an operator measured. */
  latencyMeasured?(session: SessionOperator, measured: LatencyMeasured): void;
  /** For the audit log: a request that was refused. */
  refused?(session: SessionOperator, what: 'lease' | 'estop-release', reason: string): void;
  /** An operator's goal was refused. */
  goalRefused?(session: SessionOperator, goal: GoalRequest, reason: GoalReason): void;
  /** What became of a robot command that the operator gave. */
  commandAnswered?(session: SessionOperator, id: string, answer: CommandAnswer): void;
  messageRefused(channel: string, error: ProtocolError): void;
  /** A message was dropped because there were too many of its kind. */
  messageLimited?(kind: RatedMessage): void;
  /** The driver's name by its grant; undefined if nobody drives or there are no grants. */
  driverName?(): string | undefined;
  estopCause?(operatorId: string): EstopCause | null;
}
