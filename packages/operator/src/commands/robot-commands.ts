/** The robot's commands, as buttons: which there are, and what becomes of those that are given. Time is an argument. */
import {
  type CommandAnswer,
  type CommandCall,
  type CommandOutcome,
  type CommandRefusal,
  nextSequence32,
  type RobotCommand,
} from '@farpoint/protocol';

/** What became of a command that was given here. */
export interface CommandResult {
  /** The command's id. */
  readonly id: string;
  /** The command's, for people. */
  readonly label: string;
  /** By the robot; or nobody knows: the robot did not answer, or the session ended before it did. */
  readonly outcome: CommandOutcome | 'no-answer' | 'link-lost';
  /** Why it was refused; `null` otherwise. */
  readonly reason: CommandRefusal | null;
  /** For people: what the robot's own program says of it; `null` if it says nothing. */
  readonly detail: string | null;
}

export interface CommandsPort {
  /** @returns whether there is a session that takes it */
  send(call: CommandCall): boolean;
  /** The commands, whether they may be given, or which of them wait for an answer have changed. */
  onChange(commands: readonly RobotCommand[]): void;
  onResult(result: CommandResult): void;
}

/** The robot itself answers within a minute, ms. */
const ANSWER_MS = 65_000;

interface Waiting {
  readonly request: number;
  readonly label: string;
  readonly askedMs: number;
}

/** The robot's commands in this session. {@link RobotClient} creates and calls it. */
export class RobotCommands {
  readonly #port: CommandsPort;
  readonly #commands = new Map<string, RobotCommand>();
  /** By command. */
  readonly #waiting = new Map<string, Waiting>();
  #request = 0;

  constructor(port: CommandsPort) {
    this.#port = port;
  }

  /** In the robot's order; empty if it takes none. */
  get list(): readonly RobotCommand[] {
    return [...this.#commands.values()];
  }

  /** Whether the command was given, and the robot has not answered yet. */
  isWaiting(id: string): boolean {
    return this.#waiting.has(id);
  }

  /**
   * Gives one of the robot's commands.
   *
   * @param id of one in the list
   * @param nowMs when the operator pressed, `performance.now()`
   * @returns false if there is no such command, it may not be given now, it was given already, or there is no session
   */
  give(id: string, nowMs: number): boolean {
    const command = this.#commands.get(id);
    if (command === undefined || command.barred !== undefined || this.#waiting.has(id)) return false;
    const request = nextSequence32(this.#request);
    if (!this.#port.send({ type: 'callCommand', id, request, timeMs: nowMs })) return false;
    this.#request = request;
    this.#waiting.set(id, { request, label: command.label, askedMs: nowMs });
    this.#changed();
    return true;
  }

  /** A session begins or ends. */
  reset(): void {
    for (const id of [...this.#waiting.keys()]) this.#end(id, 'link-lost');
    if (this.#commands.size === 0) return;
    this.#commands.clear();
    this.#changed();
  }

  /** The robot told a command. */
  onCommand(command: RobotCommand): void {
    this.#commands.set(command.id, command);
    this.#changed();
  }

  /** The robot said what became of one. */
  onAnswer({ request, outcome, reason, detail }: CommandAnswer): void {
    const [id] = [...this.#waiting].find(([, waiting]) => waiting.request === request) ?? [];
    if (id !== undefined) this.#end(id, outcome, reason, detail);
  }

  /** Call this now and then. @param nowMs `performance.now()` */
  tick(nowMs: number): void {
    if (this.#waiting.size === 0) return;
    for (const [id, { askedMs }] of [...this.#waiting])
      if (nowMs - askedMs >= ANSWER_MS) this.#end(id, 'no-answer');
  }

  #end(id: string, outcome: CommandResult['outcome'], reason?: CommandRefusal, detail?: string): void {
    const label = this.#waiting.get(id)?.label ?? id;
    this.#waiting.delete(id);
    this.#changed();
    this.#port.onResult({ id, label, outcome, reason: reason ?? null, detail: detail ?? null });
  }

  #changed(): void {
    this.#port.onChange(this.list);
  }
}
