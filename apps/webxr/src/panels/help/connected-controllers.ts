/** The controllers that the browser shows, with what each does. */
import { controllerKey, isStandardKey } from '../../take/drive/input-choices.ts';
import type { InputSettings } from '../../take/drive/input-settings.ts';
import type { HelpController } from '../../words/help-rows.ts';
import { controllerName } from '../../words/input-words.ts';

/**
 * Reads them anew at each call: a browser shows a gamepad once one of its buttons was pressed.
 *
 * @param settings says what each does
 */
export function connectedControllers(settings: Pick<InputSettings, 'mapOf'>): HelpController[] {
  const pads = navigator.getGamepads?.() ?? [];
  return pads.flatMap((pad) => {
    if (pad === null || pad.connected === false) return [];
    const key = controllerKey(pad);
    return [{ name: controllerName(pad.id), map: settings.mapOf(key), isStandard: isStandardKey(key) }];
  });
}
