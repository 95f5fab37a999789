/** The panel with the robot's commands, by group. */
import { computed, effect } from '@preact/signals-core';
import { steady } from '../state/steady.ts';
import { keepInRoom } from '../ui/controls-room.ts';
import { elements } from '../ui/elements.ts';
import { barWords } from './command-words.ts';
import type { CommandsState, ShownCommand } from './commands-state.ts';

/** Where there is less room, the panel is folded until it is wanted. */
const ROOMY = '(min-width: 60rem) and (min-height: 45rem)';

export function showCommands(commands: CommandsState): void {
  const { commands: panel, commandGroups } = elements;
  panel.open = window.matchMedia(ROOMY).matches;
  const buttons = new Map<string, HTMLButtonElement>();
  // A button that is made anew loses the focus: that a command changes makes none.
  const layout = steady(computed(() => commands.shown.value.map(({ id, group }) => ({ id, group }))));
  effect(() => {
    const all = layout.value;
    panel.hidden = all.length === 0;
    buttons.clear();
    for (const { id } of all) buttons.set(id, buttonOf(id, commands));
    const groups = [...new Set(all.map(({ group }) => group))];
    commandGroups.replaceChildren(
      ...groups.map((group) => {
        const within = all.filter((each) => each.group === group);
        return groupOf(
          group,
          within.flatMap(({ id }) => buttons.get(id) ?? []),
        );
      }),
    );
    for (const command of commands.shown.peek()) show(buttons.get(command.id), command);
  });
  effect(() => {
    for (const command of commands.shown.value) show(buttons.get(command.id), command);
  });
  keepInRoom(panel);
}

function groupOf(group: string, buttons: readonly HTMLButtonElement[]): HTMLElement {
  const element = document.createElement('div');
  element.role = 'group';
  element.ariaLabel = group === '' ? 'Other commands' : group;
  if (group !== '') {
    const name = document.createElement('span');
    name.className = 'group';
    name.ariaHidden = 'true';
    name.textContent = group;
    element.append(name);
  }
  element.append(...buttons);
  return element;
}

function buttonOf(id: string, commands: CommandsState): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet';
  button.dataset.command = id;
  button.append(document.createElement('span'), document.createElement('small'));
  button.addEventListener('click', ({ detail }) => {
    // The space bar stays the drive grip of whoever uses the mouse. Whoever uses the keyboard may have to press again.
    if (detail > 0) button.blur();
    commands.press(id);
  });
  // A key that is held is one press.
  button.addEventListener('keydown', (event) => {
    if (event.repeat && event.code === 'Enter') event.preventDefault();
  });
  return button;
}

function show(button: HTMLButtonElement | undefined, { text, bar, armed, waiting }: ShownCommand): void {
  if (button === undefined) return;
  const [label, why] = button.children;
  if (label !== undefined) label.textContent = text;
  if (why !== undefined) why.textContent = bar === null ? '' : barWords(bar);
  // Not `disabled`: it keeps the focus, and says why.
  button.ariaDisabled = String(bar !== null || waiting);
  button.dataset.armed = String(armed);
}
