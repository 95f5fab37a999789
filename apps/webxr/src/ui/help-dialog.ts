/** The help: what every key, button of a controller and gesture does now. Loaded when it is first opened. */
import './help.css';
import { effect, type ReadonlySignal, signal } from '@preact/signals-core';
import { STANDARD_MAP } from '../drive/controller-map.ts';
import { controllerKey, isStandardKey } from '../drive/input-choices.ts';
import type { InputSettings } from '../drive/input-settings.ts';
import { type HelpController, type HelpRow, helpGroups } from '../help/help-groups.ts';
import { helpWords } from '../status/help-words.ts';
import { controllerName } from '../status/input-words.ts';
import { dialogButton } from './dialog-parts.ts';
import { menuOf, sheetOf, textOf } from './sheet-parts.ts';

export interface HelpParts {
  readonly settings: InputSettings;
  /** Whether there is a robot that this operator may drive. */
  readonly mayTour: ReadonlySignal<boolean>;
  startTour(): void;
  openEvents(): void;
  openInputs(): void;
  saveScene(): void;
  saveClip(): void;
}

/** Makes the dialog, closed. Whoever is in it closes it by `?` as well. */
export function helpDialog(parts: HelpParts): HTMLDialogElement {
  const { settings, mayTour } = parts;
  const dialog = sheetOf('help', 'Help');
  const tour = dialogButton('First drive', 'First drive: grip, drive, STOP, release', () => {
    dialog.close();
    parts.startTour();
  });
  const groups = document.createElement('div');
  groups.className = 'groups';
  const padHint = textOf('p', helpWords.noController, 'hint small');
  dialog.append(
    menuOf(
      tour,
      dialogButton('Event log', 'Event log', () => parts.openEvents()),
      dialogButton('Save picture', 'Save picture of the scene', () => parts.saveScene()),
      dialogButton('Save clip', 'Save clip of the last 30 seconds', () => parts.saveClip()),
      dialogButton('Change keys', 'Change keys', () => parts.openInputs()),
      dialogButton('Close', 'Close', () => dialog.close()),
    ),
    textOf('p', helpWords.lead, 'hint small'),
    padHint,
    groups,
    textOf('p', helpWords.headset, 'hint small'),
  );
  dialog.addEventListener('keydown', (event) => {
    if (event.key !== '?' && !settings.keys.peek().help.includes(event.code)) return;
    // It would open the help again.
    event.preventDefault();
    dialog.close();
  });
  effect(() => {
    tour.hidden = !mayTour.value;
  });
  const pads = connectedPads();
  effect(() => {
    const connected = pads.value.map((pad): HelpController => {
      const key = controllerKey(pad);
      return { name: controllerName(pad.id), map: settings.mapOf(key), isStandard: isStandardKey(key) };
    });
    padHint.hidden = connected.length > 0;
    const usual = { name: 'Gamepad', map: STANDARD_MAP, isStandard: true };
    const listed = helpGroups(
      settings.keys.value,
      settings.oneHanded.value,
      connected.length === 0 ? [usual] : connected,
    );
    groups.replaceChildren(
      ...listed.map(({ title, rows }) => {
        const section = document.createElement('section');
        const list = document.createElement('dl');
        list.append(...rows.map(rowElement));
        section.append(textOf('h3', title), list);
        return section;
      }),
    );
  });
  return dialog;
}

function rowElement({ what, keys, controllers, hand }: HelpRow): HTMLElement {
  const row = document.createElement('div');
  const how = document.createElement('dd');
  how.append(
    ...keys.map((name) => textOf('kbd', name)),
    ...controllers.map(({ name, parts }) => textOf('span', `${name}: ${parts.join(', ')}`, 'pad')),
  );
  if (hand !== null) how.append(textOf('span', hand, 'hand'));
  if (how.childElementCount === 0) how.append(textOf('span', helpWords.none));
  row.append(textOf('dt', what), how);
  return row;
}

/** The controllers that are there, whenever one comes or goes. */
function connectedPads(): ReadonlySignal<readonly Gamepad[]> {
  const read = () => (navigator.getGamepads?.() ?? []).filter((pad) => pad?.connected === true) as Gamepad[];
  const pads = signal<readonly Gamepad[]>(read());
  for (const type of ['gamepadconnected', 'gamepaddisconnected'] as const)
    window.addEventListener(type, () => {
      pads.value = read();
    });
  return pads;
}
