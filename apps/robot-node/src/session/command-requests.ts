/** One operator and the robot's commands: which it may give, and what becomes of those that it gives. */
import type {
  CommandAnswer,
  CommandBar,
  CommandCall,
  CommandRefusal,
  RobotSessionMessage,
} from '@farpoint/protocol';
import { type Access, mayDrive } from '../access/access.ts';
import type { DriveStation } from '../drive/drive-station.ts';
import { barOf, type CommandStanding } from '../robot-commands/command-bar.ts';
import type { CommandStation } from '../robot-commands/command-station.ts';
import type { MessageRates } from './message-rates.ts';

/** A press that has been under way for so much longer than usual is not wanted any more, ms. */
const STALE_MS = 2000;

/** The operator. */
export interface CommandGiver {
  readonly id: string;
  readonly access: Access;
  /** When a message last came from it, ms on the robot's clock. */
  readonly heardMs: number;
  send(message: RobotSessionMessage): void;
}

export interface CommandPort {
  /** `null` if the robot takes no commands. */
  readonly commands: CommandStation | null;
  readonly drive: Pick<DriveStation, 'guard'>;
  readonly rates: Pick<MessageRates, 'over'>;
  /** What became of a command; also of one that the robot does not have. */
  answered(id: string, answer: CommandAnswer): void;
}

export class CommandRequests {
  readonly #operator: CommandGiver;
  readonly #port: CommandPort;
  /** What the operator was told of each command; `null` before it was told anything. */
  #told: Map<string, CommandBar | null> | null = null;

  constructor(operator: CommandGiver, port: CommandPort) {
    this.#operator = operator;
    this.#port = port;
  }

  /** Tells it all commands. */
  tell(): void {
    this.#told = new Map();
    this.update();
  }

  /** Tells it of each command whether it may give it, where that has changed. */
  update(): void {
    const told = this.#told;
    if (told === null) return;
    const standing = this.#standing();
    for (const command of this.#port.commands?.all ?? []) {
      const { id, label, group, confirm } = command;
      const bar = barOf(command, standing);
      if (told.get(id) === bar) continue;
      told.set(id, bar);
      this.#operator.send({
        ...{ type: 'robotCommand', id, label },
        ...(group === undefined ? {} : { group }),
        ...(confirm ? { confirm } : {}),
        ...(bar === null ? {} : { barred: bar }),
      });
    }
  }

  take(call: CommandCall): void {
    const { id, request } = call;
    const answer = (rest: Omit<CommandAnswer, 'type' | 'request'>) => {
      const message: CommandAnswer = { type: 'commandAnswer', request, ...rest };
      this.#port.answered(id, message);
      this.#operator.send(message);
    };
    const reason =
      this.#judge(call) ??
      this.#port.commands?.give(id, this.#operator.access.name, ({ outcome, detail }) =>
        answer({ outcome, ...(detail === '' ? {} : { detail }) }),
      );
    if (reason != null) answer({ outcome: 'refused', reason });
  }

  #judge({ id, timeMs }: CommandCall): CommandRefusal | null {
    const { drive, rates, commands } = this.#port;
    const { id: operator, heardMs } = this.#operator;
    if (rates.over('call', heardMs)) return 'too-often';
    const command = commands?.find(id) ?? null;
    if (command === null) return 'unknown';
    const bar = barOf(command, this.#standing());
    if (bar !== null) return bar;
    return drive.guard.lateMs(operator, timeMs, heardMs) <= STALE_MS ? null : 'stale';
  }

  #standing(): CommandStanding {
    const { guard } = this.#port.drive;
    const { id, access } = this.#operator;
    return {
      mayDrive: mayDrive(access),
      drives: guard.leaseHolder === id,
      estop: guard.estopState().latched,
    };
  }
}
