/** The panel with the robot's commands, by group, and its recording. */
import { computed, effect } from '@preact/signals-core';
import {
  type CommandsState,
  hasCommands,
  type ShownCommand,
  type ShownRecording,
} from '../../state/commands-state.ts';
import { steady } from '../../state/sampler.ts';
import { texts } from '../../words/language.ts';
import { elements } from './elements.ts';
import { followKey } from './key-title.ts';

/** Where there is less room, the panel is closed until it is wanted: beside cameras, it lies over the picture. */
const ROOMY = '(min-width: 90rem) and (min-height: 45rem)';

export function showCommands(commands: CommandsState): void {
  const { commands: panel } = elements;
  const [details, summary, groups] = [make('details'), make('summary'), make('div', 'groups')];
  details.open = window.matchMedia(ROOMY).matches;
  const recorder = recorderOf(commands);
  details.append(summary, recorder.element, groups);
  panel.replaceChildren(details);
  effect(() => {
    summary.textContent = texts().commands.title;
  });
  const buttons = new Map<string, CommandButton>();
  // A button that is made anew loses the focus: that a command changes makes none.
  const layout = steady(
    computed(() => commands.groups.value.map((group) => [group.name, ...group.commands.map(({ id }) => id)])),
  );
  effect(() => {
    buttons.clear();
    const made = layout.value.map(([name = '', ...ids]) => {
      const own = ids.map((id) => new CommandButton(id, commands));
      for (const each of own) buttons.set(each.id, each);
      return groupOf(name, own);
    });
    groups.replaceChildren(...made);
    for (const each of commands.groups.peek().flatMap((group) => group.commands))
      buttons.get(each.id)?.show(each);
  });
  effect(() => {
    for (const each of commands.groups.value.flatMap((group) => group.commands))
      buttons.get(each.id)?.show(each);
  });
  effect(() => recorder.show(commands.recording.value));
  effect(() => {
    panel.hidden = !hasCommands(layout.value, commands.recording.value);
  });
}

/** Adds a bookmark, with what is written in the panel. */
export function addBookmark(commands: CommandsState): void {
  const id = commands.recording.peek()?.bookmark?.id;
  const note = document.querySelector<HTMLInputElement>('#commands input');
  if (id === undefined) return;
  commands.press(id, note?.value.trim() ?? '');
  if (note !== null) note.value = '';
}

function make<Tag extends keyof HTMLElementTagNameMap>(tag: Tag, name = ''): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  if (name !== '') element.className = name;
  return element;
}

function groupOf(name: string, buttons: readonly CommandButton[]): HTMLElement {
  const element = make('div', 'group');
  element.role = 'group';
  element.ariaLabel = name === '' ? texts().commands.otherGroup : name;
  if (name !== '') {
    const heading = make('span', 'name');
    heading.ariaHidden = 'true';
    heading.textContent = name;
    element.append(heading);
  }
  element.append(...buttons.map((each) => each.element));
  return element;
}

/** One command: its button, how far it is, and what cancels it. */
class CommandButton {
  readonly element = make('div', 'command');
  /** Of the command that it gives now. */
  id: string;
  readonly #button = make('button', 'quiet');
  readonly #label = make('span');
  readonly #note = make('small');
  readonly #progress = make('progress');
  readonly #cancel = make('button', 'quiet cancel');

  constructor(id: string, commands: CommandsState, press = () => commands.press(this.id)) {
    this.id = id;
    for (const button of [this.#button, this.#cancel]) button.type = 'button';
    this.#button.append(this.#label, this.#note);
    this.#progress.ariaHidden = 'true';
    this.element.append(this.#button, this.#progress, this.#cancel);
    this.#button.addEventListener('click', ({ detail }) => {
      // The space bar stays the drive grip of whoever uses the mouse. Whoever uses the keyboard may have to press again.
      if (detail > 0) this.#button.blur();
      press();
    });
    this.#cancel.addEventListener('click', () => {
      this.#cancel.blur();
      commands.cancel(this.id);
    });
    // A key that is held is one press.
    this.#button.addEventListener('keydown', (event) => {
      if (event.repeat && event.code === 'Enter') event.preventDefault();
    });
  }

  /** Gives the command. */
  get button(): HTMLButtonElement {
    return this.#button;
  }

  show(command: ShownCommand | null): void {
    this.element.hidden = command === null;
    if (command === null) return;
    const { id, text, note, state, progress, cancel } = command;
    this.id = id;
    this.#label.textContent = text;
    this.#note.textContent = note;
    // Not `disabled`: it keeps the focus, and says why.
    this.#button.ariaDisabled = String(state === 'barred' || state === 'running');
    this.#button.dataset.state = state;
    this.#button.dataset.command = id;
    this.#progress.hidden = progress === null;
    this.#progress.value = progress ?? 0;
    this.#cancel.hidden = cancel === null;
    this.#cancel.textContent = texts().commands.cancel;
    this.#cancel.ariaLabel = cancel;
  }
}

function recorderOf(commands: CommandsState) {
  const [element, line, note] = [make('div', 'recorder'), make('span', 'line'), make('input')];
  element.role = 'group';
  const button = new CommandButton('', commands);
  const bookmark = new CommandButton('', commands, () => addBookmark(commands));
  note.type = 'text';
  note.maxLength = 120;
  note.autocomplete = 'off';
  note.addEventListener('keydown', ({ code }) => {
    if (code !== 'Enter') return;
    note.blur();
    addBookmark(commands);
  });
  const mark = make('div', 'mark');
  mark.append(note, bookmark.element);
  element.append(line, button.element, mark);
  const show = (recording: ShownRecording | null) => {
    const { recordingGroup, bookmarkTitle, bookmarkNote } = texts().commands;
    element.hidden = recording === null;
    element.ariaLabel = recordingGroup;
    bookmark.button.title = bookmarkTitle;
    followKey(bookmark.button, 'bookmark');
    note.placeholder = bookmarkNote;
    note.ariaLabel = bookmarkNote;
    line.textContent = recording?.line ?? '';
    line.dataset.on = String(recording?.isOn ?? false);
    button.show(recording?.button ?? null);
    bookmark.show(recording?.bookmark ?? null);
    note.hidden = recording?.bookmark == null || recording.bookmark.state === 'barred';
  };
  return { element, show };
}
