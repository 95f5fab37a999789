/** The help: what every key, button, axis and gesture does now. Its code is loaded when it is first opened, and it is built anew each time. */
import './help.css';
import { effect } from '@preact/signals-core';
import { STANDARD_MAP } from '../../take/drive/controller-map.ts';
import type { InputSettings } from '../../take/drive/input-settings.ts';
import { type HelpRow, helpGroups } from '../../words/help-rows.ts';
import { laterTexts, texts } from '../../words/language.ts';
import { dialogButton, headingOf, paragraphOf } from '../inputs/dialog-parts.ts';
import { openDialog } from '../ui/open-dialog.ts';
import { connectedControllers } from './connected-controllers.ts';

export interface HelpDialogParts {
  readonly settings: InputSettings;
  /** Whether there is a robot that a first drive can be made with. */
  readonly canTour: boolean;
  startTour(): void;
  openInputs(): void;
  /** The help was closed. */
  onClosed(): void;
}

export function openHelp(dialog: HTMLDialogElement, parts: HelpDialogParts): void {
  const words = laterTexts().help;
  const title = headingOf(texts().dialogs.help, 'h2');
  Object.assign(title, { id: 'help-title', tabIndex: -1, autofocus: true });
  const noController = paragraphOf(words.noController, 'hint small');
  const groups = document.createElement('div');
  groups.className = 'groups';
  dialog.replaceChildren(
    title,
    menuOf(dialog, parts),
    paragraphOf(words.lead, 'hint small'),
    noController,
    groups,
    paragraphOf(words.headset, 'hint small'),
  );
  const render = () => {
    const connected = connectedControllers(parts.settings);
    noController.hidden = connected.length > 0;
    const usual = { name: words.gamepad, map: STANDARD_MAP, isStandard: true };
    const shown = connected.length === 0 ? [usual] : connected;
    const { keys, goesSideways } = parts.settings;
    groups.replaceChildren(...helpGroups(keys.value, shown, goesSideways.value).map(sectionOf));
  };
  const disposeKeys = effect(render);
  const events = ['gamepadconnected', 'gamepaddisconnected'] as const;
  for (const type of events) window.addEventListener(type, render);
  dialog.addEventListener(
    'close',
    () => {
      disposeKeys();
      for (const type of events) window.removeEventListener(type, render);
      parts.onClosed();
    },
    { once: true },
  );
  openDialog(dialog);
}

function menuOf(dialog: HTMLDialogElement, parts: HelpDialogParts): HTMLElement {
  const { tour, close } = laterTexts().help;
  const { open } = texts().inputs;
  const leaveFor = (act: () => void) => () => {
    dialog.close();
    act();
  };
  const firstDrive = dialogButton(tour.title, tour.title, leaveFor(parts.startTour));
  firstDrive.id = 'tour-start';
  firstDrive.hidden = !parts.canTour;
  const menu = document.createElement('menu');
  const inputs = dialogButton(open, open, leaveFor(parts.openInputs));
  menu.append(
    firstDrive,
    inputs,
    dialogButton(close, close, () => dialog.close()),
  );
  // A menu's children are list items.
  menu.role = 'group';
  return menu;
}

function sectionOf({ title, rows }: ReturnType<typeof helpGroups>[number]): HTMLElement {
  const section = document.createElement('section');
  const list = document.createElement('dl');
  list.append(...rows.map(rowOf));
  section.append(headingOf(title), list);
  return section;
}

function rowOf({ what, keys, controllers, hand }: HelpRow): HTMLElement {
  const row = document.createElement('div');
  const how = document.createElement('dd');
  how.append(
    ...keys.map((name) => textOf('kbd', name)),
    ...controllers.map(({ name, parts }) => textOf('span', `${name}: ${parts.join(', ')}`, 'pad')),
  );
  if (hand !== null) how.append(textOf('span', hand, 'hand'));
  if (how.childElementCount === 0) how.append(textOf('span', laterTexts().help.none));
  row.append(textOf('dt', what), how);
  return row;
}

function textOf(tag: 'dt' | 'kbd' | 'span', text: string, className = ''): HTMLElement {
  const element = document.createElement(tag);
  element.textContent = text;
  element.className = className;
  return element;
}
