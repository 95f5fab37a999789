/** The commands that operators may give: how often, what does them, and what becomes of each. */
import { COMMAND_DETAIL_LENGTH, type CommandOutcome, type CommandRefusal } from '@farpoint/protocol';
import { TokenBucket } from '@farpoint/timing';
import { ReasonCounts } from '../telemetry/robot-counters.ts';
import type { ActionResult, CommandActor } from './command-actor.ts';
import type { CommandOptions } from './command-configuration.ts';

/** The end of a command that was not refused. */
export interface CommandEnd {
  outcome: Exclude<CommandOutcome, 'refused'>;
  /** For people; may be empty. */
  detail: string;
}

interface StationCommand {
  readonly options: CommandOptions;
  readonly actor: CommandActor;
  readonly bucket: TokenBucket;
  /** Runs while it has not ended. */
  timer: NodeJS.Timeout | null;
}

export class CommandStation {
  /** Commands that were begun, by id. */
  readonly begun = new ReasonCounts();
  /** What became of commands: an outcome other than `refused`, or why it was refused. */
  readonly outcomes = new ReasonCounts();
  readonly #commands: ReadonlyMap<string, StationCommand>;
  readonly #now: () => number;

  /** @param actorOf what does the command @param now the robot's clock, ms */
  constructor(
    commands: readonly CommandOptions[],
    actorOf: (command: CommandOptions) => CommandActor,
    now: () => number,
  ) {
    this.#now = now;
    this.#commands = new Map(
      commands.map((options) => {
        const { perSecond } = options;
        const bucket = new TokenBucket({ perSecond, burst: Math.max(1, perSecond) });
        return [options.id, { options, actor: actorOf(options), bucket, timer: null }];
      }),
    );
  }

  /** In the order of the configuration. */
  get all(): CommandOptions[] {
    return [...this.#commands.values()].map(({ options }) => options);
  }

  find(id: string): CommandOptions | null {
    return this.#commands.get(id)?.options ?? null;
  }

  /**
   * Does a command. Whoever asks must have been found to be allowed to.
   *
   * @param by the operator's name
   * @param onEnd called once if it is begun
   * @returns why it is refused; `null` if it is begun
   */
  give(id: string, by: string, onEnd: (end: CommandEnd) => void): CommandRefusal | null {
    const command = this.#commands.get(id);
    if (command === undefined) return 'unknown';
    if (command.timer !== null) return 'busy';
    if (!command.bucket.take(this.#now())) return 'too-often';
    this.begun.add(id);
    const { timeoutMs, action } = command.options;
    const timer = setTimeout(() => end({ outcome: 'timed-out', detail: '' }), timeoutMs);
    command.timer = timer;
    const end = (result: CommandEnd) => {
      // An answer that comes after its time has ended nothing.
      if (command.timer !== timer) return;
      clearTimeout(timer);
      command.timer = null;
      onEnd(result);
    };
    command.actor.act(action, timeoutMs, (result) => end(endOf(result)), by);
    return null;
  }

  async close(): Promise<void> {
    for (const { timer } of this.#commands.values()) if (timer !== null) clearTimeout(timer);
    const actors = new Set([...this.#commands.values()].map(({ actor }) => actor));
    for (const actor of actors) await actor.close();
  }
}

/** What a program says of itself is not trusted to be short or to be a line. */
function endOf({ done, detail }: ActionResult): CommandEnd {
  const line = detail.replaceAll(/\p{C}+/gu, ' ').trim();
  return { outcome: done ? 'done' : 'failed', detail: line.slice(0, COMMAND_DETAIL_LENGTH) };
}
