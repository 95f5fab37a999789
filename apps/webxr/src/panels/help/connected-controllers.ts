/** The controllers that the browser shows, with what each does. */
import { connectedPads } from '../../take/drive/connected-pads.ts';
import { isStandardKey } from '../../take/drive/input-choices.ts';
import type { InputSettings } from '../../take/drive/input-settings.ts';
import type { HelpController } from '../../words/help-rows.ts';
import { controllerName } from '../../words/input-words.ts';

/** @param settings says what each does */
export function connectedControllers(settings: Pick<InputSettings, 'mapOf'>): HelpController[] {
  return connectedPads().map(({ key, pad }) => ({
    name: controllerName(pad.id),
    map: settings.mapOf(key),
    isStandard: isStandardKey(key),
  }));
}
