/** The robot's commands as the page offers them: on the screen and in the headset. */
import type { CommandBar, RobotClient, RobotCommand } from '@farpoint/operator';
import { type ReadonlySignal, signal } from '@preact/signals-core';
import type { Words } from '../status/tone.ts';
import { armedWords, barredWords, buttonWords, resultWords, unsentWords } from './command-words.ts';
import { CONFIRM_MS, PressTwice } from './press-twice.ts';

/** A command's button. */
export interface ShownCommand {
  readonly id: string;
  /** Commands without one have the empty group. */
  readonly group: string;
  readonly text: string;
  /** Why it cannot be given now; `null` if it can. */
  readonly bar: CommandBar | null;
  /** The next press gives it. */
  readonly armed: boolean;
  /** It was given, and the robot has not answered. */
  readonly waiting: boolean;
}

export interface CommandsParts {
  readonly client: Pick<RobotClient, 'on' | 'commands'>;
  tell(words: Words): void;
  /** Page's clock, ms. */
  now(): number;
  after(ms: number, act: () => void): void;
}

export class CommandsState {
  readonly #parts: CommandsParts;
  readonly #twice = new PressTwice();
  readonly #shown = signal<readonly ShownCommand[]>([]);
  #list: readonly RobotCommand[] = [];

  /** In the robot's order. */
  readonly shown: ReadonlySignal<readonly ShownCommand[]> = this.#shown;

  constructor(parts: CommandsParts) {
    this.#parts = parts;
    const { client, tell } = parts;
    client.on('commands', (list) => {
      this.#list = list;
      const armed = list.find(({ id }) => id === this.#twice.armed(parts.now()));
      // A press from before does not confirm what was barred in between.
      if (armed === undefined || armed.barred !== undefined) this.#twice.forget();
      this.#show();
    });
    client.on('commandResult', (result) => tell(resultWords(result)));
  }

  /** A command's button was pressed. */
  press(id: string): void {
    const { client, tell, now, after } = this.#parts;
    const command = this.#list.find((each) => each.id === id);
    if (command === undefined || client.commands.isWaiting(id)) return;
    const { label, confirm, barred } = command;
    const nowMs = now();
    if (barred !== undefined) {
      this.#twice.forget();
      tell(barredWords(label, barred));
    } else if (confirm === true && !this.#twice.press(id, nowMs)) {
      tell(armedWords(label));
      after(CONFIRM_MS, () => this.#show());
    } else {
      this.#twice.forget();
      if (!client.commands.give(id, nowMs)) tell(unsentWords(label));
    }
    this.#show();
  }

  #show(): void {
    const { client, now } = this.#parts;
    const armedId = this.#twice.armed(now());
    this.#shown.value = this.#list.map(({ id, label, group = '', barred }) => {
      const [armed, waiting] = [id === armedId, client.commands.isWaiting(id)];
      const text = buttonWords(label, { armed, waiting });
      return { id, group, text, bar: barred ?? null, armed, waiting };
    });
  }
}
