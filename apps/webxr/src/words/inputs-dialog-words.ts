/** What the dialog for keys and devices says, and the names that it and the help give to what they list. */
import {
  AXIS_ROLES,
  type AxisRole,
  type ButtonRole,
  type ControllerMap,
  type MapRefusal,
  missingOf,
} from '../take/drive/controller-map.ts';
import type { KeyRefusal } from '../take/drive/key-map.ts';
import { keyName } from './input-words.ts';
import { laterTexts } from './language.ts';

export function keyRefusalWords(code: string, refusal: KeyRefusal): string {
  const { taken, full, lastStop, alwaysStops, reserved, keyRoles } = laterTexts().inputsDialog;
  switch (refusal.reason) {
    case 'last-stop':
      return lastStop;
    case 'taken':
      return taken(keyName(code), keyRoles[refusal.by]);
    case 'always-stops':
      return alwaysStops(keyName(code));
    case 'reserved':
      return reserved(keyName(code));
    case 'full':
      return full;
  }
}

/** @param what an axis or a button, by its name */
export function mapRefusalWords(what: string, refusal: MapRefusal): string {
  const { taken, full, keepsStop } = laterTexts().inputsDialog;
  switch (refusal.reason) {
    case 'taken':
      return taken(capital(what), roleWords(refusal.by));
    case 'full':
      return full;
    case 'keeps-stop':
      return keepsStop(capital(what));
  }
}

/** What is written on the buttons of a gamepad in the standard mapping, the axes of the pad as arrows. */
const STANDARD_BUTTONS = [
  'A',
  'B',
  'X',
  'Y',
  'LB',
  'RB',
  'LT',
  'RT',
  'Back',
  'Start',
  'L3',
  'R3',
  '↑',
  '↓',
  '←',
  '→',
  'Home',
] as const;

/** @param isStandard whether the browser knows which button it is */
export function buttonName(button: number, isStandard: boolean): string {
  return (isStandard ? STANDARD_BUTTONS[button] : undefined) ?? laterTexts().inputsDialog.button(button + 1);
}

/** What a sentence begins with. */
export function capital(words: string): string {
  return words.slice(0, 1).toUpperCase() + words.slice(1);
}

function roleWords(role: ButtonRole | AxisRole): string {
  const { axisRoles, buttonRoles } = laterTexts().inputsDialog;
  return isAxisRole(role) ? axisRoles[role] : buttonRoles[role];
}

function isAxisRole(role: ButtonRole | AxisRole): role is AxisRole {
  return (AXIS_ROLES as readonly string[]).includes(role);
}

/** What has been measured. @param still indexes of axes that did not move */
export function measuredWords(still: readonly number[]): string {
  const { measuredAll, notMoved, axis } = laterTexts().inputsDialog;
  return still.length === 0 ? measuredAll : notMoved(still.map((each) => axis(each + 1)).join(', '));
}

/** Why what was chosen for a device cannot be saved; `null` if it can. */
export function missingWords(map: ControllerMap): string | null {
  const missing = missingOf(map);
  return missing === null ? null : laterTexts().inputsDialog.missing[missing];
}
