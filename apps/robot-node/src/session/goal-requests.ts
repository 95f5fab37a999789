/** One operator's goals: who may name one, how often, and what it is told. */
import type { GoalCancel, GoalReason, GoalRequest, RobotSessionMessage } from '@farpoint/protocol';
import { type Access, mayDrive } from '../access/access.ts';
import type { DriveStation } from '../drive/drive-station.ts';
import type { MessageRates } from './message-rates.ts';

/** The operator whose goals they are. */
export interface GoalOperator {
  readonly id: string;
  readonly access: Access;
  /** When a message last came from it, ms on the robot's clock. */
  readonly heardMs: number;
  send(message: RobotSessionMessage): void;
}

export interface GoalPort {
  readonly drive: DriveStation;
  readonly rates: MessageRates;
  refused(goal: GoalRequest, reason: GoalReason): void;
}

export class GoalRequests {
  readonly #operator: GoalOperator;
  readonly #port: GoalPort;

  constructor(operator: GoalOperator, port: GoalPort) {
    this.#operator = operator;
    this.#port = port;
  }

  take(goal: GoalRequest): void {
    const { drive, refused } = this.#port;
    const reason = this.#judge(goal);
    // The goal before may have ended.
    drive.apply();
    if (reason === null) return;
    refused(goal, reason);
    this.#operator.send({ type: 'goalState', id: goal.id, state: 'refused', reason });
  }

  cancel({ id }: GoalCancel): void {
    const { drive } = this.#port;
    drive.guard.onGoalCancel(this.#operator.id, id);
    drive.apply();
  }

  #judge(goal: GoalRequest): GoalReason | null {
    const { id, access, heardMs } = this.#operator;
    if (this.#port.rates.over('goal', heardMs)) return 'rate-limited';
    if (!mayDrive(access)) return 'not-permitted';
    return this.#port.drive.guard.onGoal(id, goal, heardMs);
  }
}
