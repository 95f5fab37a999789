/** The robot's commands and its recording as the page offers them. */
import type { RobotClient, RobotCommand } from '@farpoint/operator';
import type { ReadonlySignal } from '@preact/signals-core';
import { barredWords, commandNote, endWords, recordingLine } from '../words/command-words.ts';
import { texts } from '../words/language.ts';
import type { Words } from '../words/words.ts';
import { PressTwice } from './press-twice.ts';
import { type Sampler, steady } from './sampler.ts';

/** A command's button. */
export interface ShownCommand {
  readonly id: string;
  readonly text: string;
  /** Below it: why it cannot be given, or what it does; may be empty. */
  readonly note: string;
  /** `armed`: the next press gives it. */
  readonly state: 'free' | 'barred' | 'armed' | 'running';
  /** How much of it is done, 0–1; `null` if nobody can tell. */
  readonly progress: number | null;
  /** What cancels it, for people; `null` if it cannot be cancelled now. */
  readonly cancel: string | null;
}

export interface ShownGroup {
  readonly name: string;
  readonly commands: readonly ShownCommand[];
}

export interface ShownRecording {
  readonly isOn: boolean;
  /** For how long, and how much. */
  readonly line: string;
  /** Begins it, or ends it; `null` if operators cannot. */
  readonly button: ShownCommand | null;
  /** `null` if nothing can be marked. */
  readonly bookmark: ShownCommand | null;
}

/** Whether there is anything to offer. */
export function hasCommands(groups: readonly unknown[], recording: ShownRecording | null): boolean {
  return groups.length > 0 || recording !== null;
}

export interface CommandsParts {
  readonly client: Pick<RobotClient, 'on' | 'commands'>;
  readonly samples: Sampler;
  tell(words: Words): void;
  /** Page's clock, ms. */
  now(): number;
}

export class CommandsState {
  readonly #parts: CommandsParts;
  readonly #twice = new PressTwice();

  /** Those that have nothing to do with recording, by group, in the robot's order. */
  readonly groups: ReadonlySignal<readonly ShownGroup[]>;
  /** `null` if operators can do nothing about recordings, and nothing is recorded. */
  readonly recording: ReadonlySignal<ShownRecording | null>;

  constructor(parts: CommandsParts) {
    this.#parts = parts;
    const { client, samples, tell } = parts;
    this.groups = steady(samples.of(() => this.#groups()));
    this.recording = steady(samples.of(() => this.#recording()));
    client.on('commands', ({ list }) => {
      const armed = list.find(({ id }) => id === this.#twice.armed(parts.now()));
      // A press from before does not confirm what was barred in between.
      if (armed?.barred !== undefined) this.#twice.forget();
    });
    client.on('commandEnd', (end) => {
      if (end.by === null) tell(endWords(end));
    });
  }

  /** A command's button was pressed. @param text of a bookmark */
  press(id: string, text = ''): void {
    const { client, tell, now } = this.#parts;
    const command = client.commands.list.find((each) => each.id === id);
    if (command === undefined || client.commands.running(id) !== null) return;
    const { label, confirm, barred } = command;
    const nowMs = now();
    if (barred !== undefined) {
      this.#twice.forget();
      tell(barredWords(label, barred));
    } else if (confirm === true && !this.#twice.press(id, nowMs)) {
      tell({ text: texts().commands.pressAgain(label), tone: 'neutral' });
    } else {
      this.#twice.forget();
      if (!client.commands.give(id, nowMs, text))
        tell({ text: texts().commands.unsent(label), tone: 'warning' });
    }
  }

  cancel(id: string): void {
    this.#parts.client.commands.cancel(id);
  }

  #groups(): ShownGroup[] {
    const { list } = this.#parts.client.commands;
    const others = list.filter(({ recording }) => recording === undefined);
    const names = [...new Set(others.map(({ group }) => group ?? ''))];
    return names.map((name) => ({
      name,
      commands: others.filter(({ group = '' }) => group === name).map((command) => this.#shown(command)),
    }));
  }

  #recording(): ShownRecording | null {
    const { list, recording } = this.#parts.client.commands;
    const isOn = recording !== null;
    const of = (role: NonNullable<RobotCommand['recording']>) => {
      const command = list.find((each) => each.recording === role);
      return command === undefined ? null : this.#shown(command);
    };
    const button = of(isOn ? 'stop' : 'start');
    const bookmark = isOn ? of('bookmark') : null;
    if (!isOn && button === null) return null;
    return { isOn, line: recordingLine(recording), button, bookmark };
  }

  #shown({ id, label, barred, cancel }: RobotCommand): ShownCommand {
    const { client, now } = this.#parts;
    const running = client.commands.running(id);
    const { again, cancelTitle } = texts().commands;
    const isArmed = running === null && this.#twice.armed(now()) === id;
    const free = barred === undefined ? 'free' : 'barred';
    return {
      id,
      text: isArmed ? again(label) : label,
      note: commandNote(barred ?? null, running),
      state: running !== null ? 'running' : isArmed ? 'armed' : free,
      progress: running?.progress ?? null,
      cancel: cancel === true && running !== null && running.run !== null ? cancelTitle(label) : null,
    };
  }
}
