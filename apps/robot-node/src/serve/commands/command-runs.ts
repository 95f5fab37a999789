/** Commands that were begun: how often each may be, what does it, and what becomes of it. Time is an argument. */
import { COMMAND_DETAIL_LENGTH, type CommandRefusal, type CommandState } from '@farpoint/protocol';
import { TokenBucket } from '@farpoint/timing';
import { ReasonCounts } from '../../ground/robot-counters.ts';
import type { ActionResult, CommandActor } from './command-actor.ts';
import type { CommandOptions } from './command-configuration.ts';

/**
 * What was asked to cancel has this time to say so, ms. Chosen: an action server answers within its own loop, and
 * people wait no longer; command-runs.test.ts holds it.
 */
const CANCEL_MS = 2000;
/** Progress is told this often at most, ms. Chosen: a bar that moves five times a second is smooth enough; command-runs.test.ts holds it. */
const PROGRESS_MS = 200;

/** Who gave a command. */
export interface RunGiver {
  /** Its session. */
  readonly session: string;
  readonly name: string;
  readonly request: number;
  /** Of a bookmark; otherwise empty. */
  readonly text: string;
}

/** A command that was begun. */
export interface CommandRunInfo<Giver extends RunGiver = RunGiver> {
  readonly run: number;
  readonly command: CommandOptions;
  readonly giver: Giver;
  readonly state: CommandState;
  /** 0–1; `null` if nobody can tell. */
  readonly progress: number | null;
  /** For people; may be empty. */
  readonly detail: string;
}

interface OpenRun<Giver extends RunGiver> extends CommandRunInfo<Giver> {
  state: CommandState;
  progress: number | null;
  detail: string;
  cancel: (() => void) | null;
  /** Nobody waits for its end any more from then on, ms. */
  endsMs: number;
  /** By whom it was to be cancelled; `null`: it was not. */
  cancelledBy: string | null;
  toldMs: number;
  news: boolean;
}

interface KnownCommand<Giver extends RunGiver> {
  readonly options: CommandOptions;
  readonly actor: CommandActor;
  readonly bucket: TokenBucket;
  /** While it has not ended. */
  run: OpenRun<Giver> | null;
}

export class CommandRuns<Giver extends RunGiver = RunGiver> {
  /** Commands that were begun, by id. */
  readonly begun = new ReasonCounts();
  readonly #commands: ReadonlyMap<string, KnownCommand<Giver>>;
  readonly #now: () => number;
  readonly #changed: (run: CommandRunInfo<Giver>) => void;
  #last = 0;

  /** @param actorOf what does the command @param changed called at the beginning, at the end, and while it says something */
  constructor(
    commands: readonly CommandOptions[],
    actorOf: (command: CommandOptions) => CommandActor,
    now: () => number,
    changed: (run: CommandRunInfo<Giver>) => void,
  ) {
    this.#now = now;
    this.#changed = changed;
    this.#commands = new Map(
      commands.map((options) => {
        const { perSecond } = options;
        const bucket = new TokenBucket({ perSecond, burst: Math.max(1, perSecond) });
        return [options.id, { options, actor: actorOf(options), bucket, run: null }];
      }),
    );
  }

  /** In the order of the configuration. */
  get all(): readonly CommandOptions[] {
    return [...this.#commands.values()].map(({ options }) => options);
  }

  /** Those that have not ended. */
  get open(): readonly CommandRunInfo<Giver>[] {
    return [...this.#commands.values()].flatMap(({ run }) => run ?? []);
  }

  find(id: string): CommandOptions | null {
    return this.#commands.get(id)?.options ?? null;
  }

  /** Begins a command. Whoever asks must have been found to be allowed to. @returns why it is refused; `null` if it is begun */
  give(id: string, giver: Giver): CommandRefusal | null {
    const command = this.#commands.get(id);
    if (command === undefined) return 'unknown';
    if (command.run !== null) return 'busy';
    const now = this.#now();
    if (!command.bucket.take(now)) return 'too-often';
    this.begun.add(id);
    const { options } = command;
    const run: OpenRun<Giver> = {
      run: ++this.#last,
      command: options,
      giver,
      state: 'running',
      progress: null,
      detail: '',
      cancel: null,
      endsMs: now + options.timeoutMs,
      cancelledBy: null,
      toldMs: now,
      news: false,
    };
    command.run = run;
    this.#changed(run);
    const order = { action: options.action, timeoutMs: options.timeoutMs, by: giver.name, text: giver.text };
    run.cancel = command.actor.begin(order, {
      progress: (share, detail) => {
        run.progress = share === null ? null : Math.min(1, Math.max(0, share));
        run.detail = lineOf(detail);
        run.news = true;
      },
      end: (result) => this.#end(command, run, endOf(result, run.cancelledBy)),
    });
    return null;
  }

  /** @param by for people: who wants it @returns why it is refused; `null` if what does it was asked */
  cancel(number: number, by: string): CommandRefusal | null {
    const run = this.open.find((each) => each.run === number) as OpenRun<Giver> | undefined;
    if (run === undefined) return 'unknown';
    if (run.cancel === null) return 'not-cancellable';
    this.#ask(run, by);
    return null;
  }

  /** The emergency stop was latched: what it cancels is cancelled, and what cannot be is not waited for any more. */
  stop(): void {
    for (const command of this.#commands.values()) {
      const { run, options } = command;
      if (run === null || options.onStop === 'continue') continue;
      if (run.cancel !== null) this.#ask(run, 'STOP');
      else this.#end(command, run, { state: 'cancelled', detail: 'by STOP; it may be done or not' });
    }
  }

  /** Ends what has taken too long, and tells what progresses. Call this every 25 ms. */
  update(): void {
    const now = this.#now();
    for (const command of this.#commands.values()) {
      const { run } = command;
      if (run === null) continue;
      if (now >= run.endsMs) {
        run.cancel?.();
        const { cancelledBy } = run;
        const detail = cancelledBy === null ? '' : `by ${cancelledBy}; nothing has confirmed it`;
        this.#end(command, run, { state: cancelledBy === null ? 'timed-out' : 'cancelled', detail });
      } else if (run.news && now - run.toldMs >= PROGRESS_MS) {
        [run.news, run.toldMs] = [false, now];
        this.#changed(run);
      }
    }
  }

  /** Cancels what runs, and closes what does the commands. */
  async close(): Promise<void> {
    for (const { run } of this.#commands.values()) run?.cancel?.();
    for (const actor of new Set([...this.#commands.values()].map((each) => each.actor))) await actor.close();
  }

  #ask(run: OpenRun<Giver>, by: string): void {
    if (run.cancelledBy !== null) return;
    run.cancelledBy = by;
    run.endsMs = Math.min(run.endsMs, this.#now() + CANCEL_MS);
    run.cancel?.();
  }

  #end(
    command: KnownCommand<Giver>,
    run: OpenRun<Giver>,
    { state, detail }: Pick<CommandRunInfo, 'state' | 'detail'>,
  ): void {
    // An answer that comes after its time has ended nothing.
    if (command.run !== run) return;
    command.run = null;
    [run.state, run.detail, run.progress] = [state, detail, null];
    this.#changed(run);
  }
}

/** What was to be cancelled and has failed was cancelled: action servers differ in what they call that. */
function endOf({ state, detail }: ActionResult, cancelledBy: string | null) {
  const line = lineOf(detail);
  if (cancelledBy === null || state === 'done') return { state, detail: line };
  return { state: 'cancelled' as const, detail: line === '' ? `by ${cancelledBy}` : line };
}

/** What a program says of itself is not trusted to be short or to be a line. */
function lineOf(detail: string): string {
  return detail
    .replaceAll(/\p{C}+/gu, ' ')
    .trim()
    .slice(0, COMMAND_DETAIL_LENGTH)
    .toWellFormed();
}
