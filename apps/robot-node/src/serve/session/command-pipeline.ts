/**
 * The way of a command on the robot, from an operator's message to the wheels:
 *
 * 1. decode it (operator-messages.ts, packages/protocol/src/control.ts),
 * 2. ask whether the operator may drive at all (admit/access),
 * 3. let the drive guard judge it: age, order, emergency stop, lease, grip (packages/safety/src/drive-guard.ts, command-gate.ts),
 * 4. record what was made of it,
 * 5. move the wheels by it: motion guards, ramp, sink (motion/drive/drive-station.ts, packages/safety/src/motion),
 * 6. answer: count it, begin its latency test, or say why it was refused.
 */
import {
  type Command,
  type CommandRejected,
  isZeroTwist,
  NO_LEASE,
  type ProtocolError,
} from '@farpoint/protocol';
import { type CommandVerdict, type RejectedCommand, RejectionReporter } from '@farpoint/safety';
import type { DriveStation } from '../../motion/drive/drive-station.ts';

/** How much of a malformed command's text goes into the report. */
const MAX_DETAIL = 200;
export const NOT_PERMITTED: RejectedCommand = {
  accepted: false,
  reason: 'not-permitted',
  detail: 'your grant lets you watch this robot, not drive it',
};

/** What one operator's commands need from its session, and what they lead to. */
export interface CommandHost {
  readonly drive: Pick<DriveStation, 'guard' | 'apply'>;
  now(): number;
  /** Whether the operator's grant lets it drive. */
  mayDrive(): boolean;
  judged(command: Command, verdict: CommandVerdict): void;
  accepted(): void;
  /** When the robot had it, had judged it, and had told the drive; `wheelsMs` is `null` if it was refused. */
  timed(sequence: number, receivedMs: number, judgedMs: number, wheelsMs: number | null): void;
  rejected(verdict: RejectedCommand): void;
  latencyTestRequested(id: number, commandMs: number): void;
  report(rejected: CommandRejected): void;
}

export class CommandPipeline {
  readonly #operator: string;
  readonly #host: CommandHost;
  readonly #rejections = new RejectionReporter();

  /** @param operator the id by which the guard knows the operator */
  constructor(operator: string, host: CommandHost) {
    this.#operator = operator;
    this.#host = host;
  }

  onCommand(command: Command, nowMs: number): void {
    const { drive } = this.#host;
    const verdict = this.#host.mayDrive()
      ? drive.guard.onCommand(this.#operator, command, nowMs)
      : NOT_PERMITTED;
    // It only says that its hand is open.
    if (command.lease === NO_LEASE && isZeroTwist(command.twist)) return;
    const judgedMs = this.#host.now();
    this.#host.judged(command, verdict);
    // Also after a rejection: releasing the grip stops the robot.
    drive.apply();
    this.#host.timed(command.sequence, nowMs, judgedMs, verdict.accepted ? this.#host.now() : null);
    if (!verdict.accepted) {
      this.#reject(verdict, command.sequence);
      return;
    }
    this.#host.accepted();
    if (command.latencyTest !== undefined) this.#host.latencyTestRequested(command.latencyTest, nowMs);
  }

  /** A control message that cannot be read counts as a malformed command. */
  onMalformed({ message }: ProtocolError, nowMs: number): void {
    const detail = message.slice(0, MAX_DETAIL);
    this.#reject(this.#host.drive.guard.onMalformed(this.#operator, detail, nowMs), undefined);
  }

  /** Reports rejections that were held back to limit their rate. Call a few times a second. */
  flushRejections(): void {
    for (const report of this.#rejections.due(this.#host.now())) this.#host.report(report);
  }

  #reject(verdict: RejectedCommand, sequence: number | undefined): void {
    this.#host.rejected(verdict);
    const report = this.#rejections.add(verdict, sequence, this.#host.now());
    if (report !== null) this.#host.report(report);
  }
}
