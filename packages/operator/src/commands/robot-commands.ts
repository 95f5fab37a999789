/** The robot's commands, as buttons: which there are, and what becomes of those that are given. Time is an argument. */
import {
  type CommandCall,
  type CommandCancel,
  type CommandRefusal,
  type CommandRefused,
  type CommandRun,
  type CommandState,
  MAX_ROBOT_COMMANDS,
  nextSequence32,
  type RecordingState,
  type RobotCommand,
} from '@farpoint/protocol';

/** A command that runs now, or was given here and is not answered yet. */
export interface CommandRunning {
  /** Names it in {@link RobotCommands.cancel}; `null` until the robot has answered. */
  readonly run: number | null;
  /** Who gave it; `null` for this operator. */
  readonly by: string | null;
  /** How much of it is done, 0–1; `null` if nobody can tell. */
  readonly progress: number | null;
  /** For people: what the robot's own program says of it; `null` if it says nothing. */
  readonly detail: string | null;
}

/** What has become of a command. */
export interface CommandEnd {
  /** The command's id. */
  readonly id: string;
  /** The command's, for people. */
  readonly label: string;
  /** Who gave it; `null` for this operator. */
  readonly by: string | null;
  /** By the robot; or nobody knows: the robot did not answer, or the session ended before it did. */
  readonly outcome: Exclude<CommandState, 'running'> | 'refused' | 'no-answer' | 'link-lost';
  /** Why it was refused; `null` otherwise. */
  readonly reason: CommandRefusal | null;
  /** For people: what the robot's own program says of it; `null` if it says nothing. */
  readonly detail: string | null;
}

export interface CommandsPort {
  /** @returns whether there is a session that takes it */
  send(request: CommandCall | CommandCancel): boolean;
  /** The commands, what runs, or the recording has changed. */
  onChange(commands: RobotCommands): void;
  onEnd(end: CommandEnd): void;
}

/** The robot says at once whether it begins a command, ms. Chosen: longer than a path is restored; robot-commands.test.ts holds it. */
const ANSWER_MS = 10_000;

interface Waiting {
  readonly request: number;
  readonly askedMs: number;
}

/** The robot's commands in this session. {@link RobotClient} creates and calls it. */
export class RobotCommands {
  readonly #port: CommandsPort;
  readonly #commands = new Map<string, RobotCommand>();
  /** By command: given here, and not answered. */
  readonly #waiting = new Map<string, Waiting>();
  /** By command. */
  readonly #running = new Map<string, CommandRunning>();
  #recording: RecordingState | null = null;
  #request = 0;

  /** @param port where requests go, and who is told */
  constructor(port: CommandsPort) {
    this.#port = port;
  }

  /** In the robot's order; empty if it takes none. */
  get list(): readonly RobotCommand[] {
    return [...this.#commands.values()];
  }

  /** What the robot records now, as it said last; `null` if it does not. */
  get recording(): RecordingState | null {
    return this.#recording;
  }

  /** Whether and how the command runs; `null` if it does not. @param id of one in the list */
  running(id: string): CommandRunning | null {
    const waits = this.#waiting.has(id) ? { run: null, by: null, progress: null, detail: null } : null;
    return this.#running.get(id) ?? waits;
  }

  /**
   * Gives one of the robot's commands.
   *
   * @param id of one in the list
   * @param nowMs when the operator pressed, `performance.now()`
   * @param text of a bookmark: at most 120 characters, on one line
   * @returns false if there is no such command, it may not be given now, it runs already, or there is no session
   */
  give(id: string, nowMs: number, text?: string): boolean {
    const command = this.#commands.get(id);
    if (command === undefined || command.barred !== undefined || this.running(id) !== null) return false;
    const request = nextSequence32(this.#request);
    const more = text === undefined || text === '' ? {} : { text };
    if (!this.#port.send({ type: 'callCommand', id, request, timeMs: nowMs, ...more })) return false;
    this.#request = request;
    this.#waiting.set(id, { request, askedMs: nowMs });
    this.#changed();
    return true;
  }

  /** Cancels what runs of a command, whoever gave it. @param id of one in the list @returns false if nothing can be cancelled */
  cancel(id: string): boolean {
    const run = this.#running.get(id)?.run ?? null;
    if (run === null || this.#commands.get(id)?.cancel !== true) return false;
    return this.#port.send({ type: 'cancelCommand', run });
  }

  /** A session begins or ends. */
  reset(): void {
    for (const id of [...this.#waiting.keys()]) this.#end(id, { by: null, outcome: 'link-lost' });
    for (const [id, { by }] of [...this.#running]) {
      if (by === null) this.#end(id, { by, outcome: 'link-lost' });
    }
    const had = this.#commands.size + this.#running.size > 0 || this.#recording !== null;
    this.#commands.clear();
    this.#running.clear();
    this.#recording = null;
    if (had) this.#changed();
  }

  /** The robot told a command. More than a robot may have are ignored. */
  onCommand(command: RobotCommand): void {
    if (!this.#commands.has(command.id) && this.#commands.size >= MAX_ROBOT_COMMANDS) return;
    this.#commands.set(command.id, command);
    this.#changed();
  }

  /** The robot said what becomes of one that it has told. */
  onRun({ run, id, by, request, state, progress, detail }: CommandRun): void {
    if (!this.#commands.has(id)) return;
    if (request !== undefined && this.#waiting.get(id)?.request === request) this.#waiting.delete(id);
    const who = request === undefined ? by.name : null;
    const said = detail ?? null;
    if (state === 'running') {
      this.#running.set(id, { run, by: who, progress: progress ?? null, detail: said });
      this.#changed();
    } else this.#end(id, { by: who, outcome: state, detail: said });
  }

  /** The robot refused one. */
  onRefused({ request, reason }: CommandRefused): void {
    const [id] = [...this.#waiting].find(([, waiting]) => waiting.request === request) ?? [];
    if (id === undefined) return;
    this.#waiting.delete(id);
    this.#changed();
    this.#tell(id, { by: null, outcome: 'refused', reason });
  }

  /** The robot said how much it has recorded. */
  onRecording(recording: RecordingState): void {
    this.#recording = recording.on ? recording : null;
    this.#changed();
  }

  /** Call this now and then. @param nowMs `performance.now()` */
  tick(nowMs: number): void {
    if (this.#waiting.size === 0) return;
    for (const [id, { askedMs }] of [...this.#waiting])
      if (nowMs - askedMs >= ANSWER_MS) this.#end(id, { by: null, outcome: 'no-answer' });
  }

  #end(id: string, end: Pick<CommandEnd, 'by' | 'outcome'> & Partial<CommandEnd>): void {
    this.#waiting.delete(id);
    this.#running.delete(id);
    this.#changed();
    this.#tell(id, end);
  }

  #tell(id: string, end: Pick<CommandEnd, 'by' | 'outcome'> & Partial<CommandEnd>): void {
    const label = this.#commands.get(id)?.label ?? id;
    this.#port.onEnd({ id, label, reason: null, detail: null, ...end });
  }

  #changed(): void {
    this.#port.onChange(this);
  }
}
