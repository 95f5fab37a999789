/** Operators and the robot's commands: which each may give, and who is told what becomes of them. */
import {
  type CommandBar,
  type CommandCall,
  type CommandCancel,
  type CommandRefusal,
  type CommandRun,
  type NamedOperator,
  sequenceDelta32,
} from '@farpoint/protocol';
import type { DriveGuard } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import { isHere, type ListedOperator, type OperatorRoster } from '../../admit/access/operator-roster.ts';
import type { RobotAudit } from '../../admit/audit/robot-audit.ts';
import { LimitedLines } from '../../ground/limited-lines.ts';
import type { RobotCounters } from '../../ground/robot-counters.ts';
import type { RecordControl } from '../../tell/record-control.ts';
import { isCancellable } from './command-actor.ts';
import { barOf, type CommandStanding, whoBarOf } from './command-bar.ts';
import type { CommandOptions } from './command-configuration.ts';
import { type CommandRunInfo, CommandRuns, type RunGiver } from './command-runs.ts';
import type { RobotCommands } from './open-commands.ts';

/** Calls of one operator. Chosen: a hand that presses as fast as it can; command-desk.test.ts holds it. */
const CALLS = { perSecond: 5, burst: 10 };
/** A press that has been under way for so much longer than usual is not wanted any more, ms. Chosen: who pressed has looked elsewhere by then; command-desk.test.ts holds it. */
const STALE_MS = 2000;
/** How often operators are told how much is recorded, ms. Chosen: seconds are what is shown; command-desk.test.ts holds it. */
const RECORDING_MS = 1000;

export interface CommandDeskOptions {
  operators: ReadonlyMap<string, ListedOperator>;
  roster: OperatorRoster;
  drive: { readonly guard: Pick<DriveGuard, 'leaseHolder' | 'estopState' | 'lateMs'> };
  /** Whether the robot stands still. */
  stands: () => boolean;
  now: () => number;
  commands: RobotCommands;
  counters: Pick<RobotCounters, 'commandCalls' | 'commandOutcomes' | 'messagesRefused'>;
  audit: Pick<RobotAudit, 'command' | 'refused'>;
  log: Pick<Logger, 'info'>;
}

interface Giver extends RunGiver {
  readonly operator: ListedOperator;
  /** As it was when it gave the command: it may have left since. */
  readonly named: NamedOperator;
}

/** What is known of one operator. */
interface Caller {
  readonly calls: TokenBucket;
  /** What it was told of each command. */
  readonly told: Map<string, CommandBar | null>;
  lastRequest: number | null;
}

export class CommandDesk {
  readonly #options: CommandDeskOptions;
  readonly #runs: CommandRuns<Giver>;
  readonly #recording: RecordControl | null;
  readonly #callers = new WeakMap<ListedOperator, Caller>();
  readonly #lines = new LimitedLines();
  #latch: number | undefined;
  #recordingDueMs = 0;
  #recorded = false;

  constructor(options: CommandDeskOptions) {
    this.#options = options;
    const { commands, actorOf, recording } = options.commands;
    this.#recording = recording;
    this.#runs = new CommandRuns(commands, actorOf, options.now, (run) => this.#changed(run));
    this.#latch = options.drive.guard.estopState().latch;
  }

  /** Tells an operator, whose session begins, all commands and what runs. */
  welcome(operator: ListedOperator): void {
    const caller = this.#callerOf(operator);
    caller.told.clear();
    this.#tell(operator, caller);
    for (const run of this.#runs.open) operator.messages.send(messageOf(run, operator));
    if (this.#recorded) this.#sendRecording([operator]);
  }

  /** Cancels what STOP cancels, ends what took too long, and tells what has changed. Call this every 25 ms. */
  update(): void {
    const { latched, latch } = this.#options.drive.guard.estopState();
    // Also a latch that was released again in between.
    if (latch !== this.#latch || latched) this.#runs.stop();
    this.#latch = latch;
    this.#runs.update();
    for (const operator of this.#here()) {
      const caller = this.#callers.get(operator);
      if (caller !== undefined) this.#tell(operator, caller);
    }
    this.#updateRecording();
  }

  /** An operator gives a command, or cancels one. */
  request(operator: ListedOperator, request: CommandCall | CommandCancel): void {
    if (!isHere(operator)) return;
    const { counters, audit } = this.#options;
    const isCall = request.type === 'callCommand';
    const reason = isCall ? this.#call(operator, request) : this.#cancel(operator, request);
    if (reason === null) return;
    counters.commandOutcomes.add(reason);
    audit.refused('robot-command', reason, operator.messages);
    const number = isCall ? request.request : request.run;
    operator.messages.send({ type: 'commandRefused', request: number, reason });
  }

  close(): Promise<void> {
    return this.#runs.close();
  }

  #call(operator: ListedOperator, { id, request, timeMs, text }: CommandCall): CommandRefusal | null {
    const { drive, roster, now } = this.#options;
    const { messages } = operator;
    const caller = this.#callerOf(operator);
    if (!caller.calls.take(now())) return 'too-often';
    if (caller.lastRequest !== null && sequenceDelta32(request, caller.lastRequest) <= 0) return 'repeated';
    caller.lastRequest = request;
    const command = this.#runs.find(id);
    if (command === null) return 'unknown';
    const bar = barOf(command, messages.access, this.#standing(operator));
    if (bar !== null) return bar;
    if (text !== undefined && !isBookmark(command)) return 'no-text';
    if (drive.guard.lateMs(messages.id, timeMs, messages.heardMs) > STALE_MS) return 'stale';
    const named = roster.nameOf(operator);
    const giver = { session: messages.id, name: named.name, request, text: text ?? '', operator, named };
    return this.#runs.give(id, giver);
  }

  #cancel(operator: ListedOperator, { run }: CommandCancel): CommandRefusal | null {
    const { roster, now } = this.#options;
    if (!this.#callerOf(operator).calls.take(now())) return 'too-often';
    const info = this.#runs.open.find((each) => each.run === run);
    if (info === undefined) return 'unknown';
    const { drives } = this.#standing(operator);
    // Whoever began it may end it, also after somebody else has taken the drive.
    const bar =
      info.giver.operator === operator ? null : whoBarOf(info.command, operator.messages.access, drives);
    return bar ?? this.#runs.cancel(run, roster.nameOf(operator).name);
  }

  /** Tells it of each command whether it may give it, where that has changed. */
  #tell(operator: ListedOperator, { told }: Caller): void {
    const standing = this.#standing(operator);
    for (const command of this.#runs.all) {
      const { id, label, group, confirm, action } = command;
      const bar = barOf(command, operator.messages.access, standing);
      if (told.get(id) === bar) continue;
      told.set(id, bar);
      operator.messages.send({
        type: 'robotCommand',
        id,
        label,
        ...(group === undefined ? {} : { group }),
        ...(confirm ? { confirm } : {}),
        ...(isCancellable(action) ? { cancel: true } : {}),
        ...(action.kind === 'record' ? { recording: action.action } : {}),
        ...(bar === null ? {} : { barred: bar }),
      });
    }
  }

  #changed(run: CommandRunInfo<Giver>): void {
    const { counters, audit, log, now } = this.#options;
    const { command, giver, state, detail } = run;
    if (state === 'running' && run.progress === null && detail === '') {
      counters.commandCalls.add(command.id);
      audit.command(giver.operator.messages, run.run, command.id, state, giver.text);
    } else if (state !== 'running') {
      counters.commandOutcomes.add(state);
      audit.command(giver.operator.messages, run.run, command.id, state, detail);
      const leftOut = this.#lines.take(now());
      const unreported = leftOut === null || leftOut === 0 ? {} : { unreported: leftOut };
      if (leftOut !== null)
        log.info({ command: command.id, by: giver.name, state, detail, ...unreported }, 'robot command');
    }
    for (const operator of this.#here()) operator.messages.send(messageOf(run, operator));
  }

  #updateRecording(): void {
    const writes = this.#recording?.writes ?? false;
    const now = this.#options.now();
    if (!writes && !this.#recorded) return;
    if (writes && this.#recorded && now < this.#recordingDueMs) return;
    [this.#recorded, this.#recordingDueMs] = [writes, now + RECORDING_MS];
    this.#sendRecording(this.#here());
  }

  #sendRecording(operators: Iterable<ListedOperator>): void {
    const { bytes, forS } = this.#recording?.progress ?? { bytes: 0, forS: 0 };
    for (const { messages } of operators)
      messages.send({ type: 'recording', on: this.#recorded, bytes, forS: Math.floor(forS) });
  }

  #here(): ListedOperator[] {
    return [...this.#options.operators.values()].filter(isHere);
  }

  #callerOf(operator: ListedOperator): Caller {
    const known = this.#callers.get(operator);
    if (known !== undefined) return known;
    const caller: Caller = { calls: new TokenBucket(CALLS), told: new Map(), lastRequest: null };
    this.#callers.set(operator, caller);
    return caller;
  }

  #standing({ messages }: ListedOperator): CommandStanding {
    const { drive, stands } = this.#options;
    const { leaseHolder } = drive.guard;
    return { drives: leaseHolder === messages.id, estop: drive.guard.estopState().latched, moves: !stands() };
  }
}

function isBookmark({ action }: CommandOptions): boolean {
  return action.kind === 'record' && action.action === 'bookmark';
}

function messageOf(
  { run, command, giver, state, progress, detail }: CommandRunInfo<Giver>,
  to: ListedOperator,
): CommandRun {
  return {
    type: 'commandRun',
    run,
    id: command.id,
    by: giver.named,
    state,
    ...(giver.operator === to ? { request: giver.request } : {}),
    ...(progress === null ? {} : { progress }),
    ...(detail === '' ? {} : { detail }),
  };
}
