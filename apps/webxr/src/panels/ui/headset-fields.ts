/** The headset's part of the settings dialog. */
import { type HeadsetSettings, parseHeadset } from '../../ground/headset-settings.ts';

const CHOICES = ['turn', 'posture', 'driveHand'] as const;
const NUMBERS = ['snapDegrees', 'vignette', 'frameRate', 'foveation', 'resolution'] as const;

type Field = HTMLInputElement | HTMLSelectElement;

function fieldOf(form: HTMLFormElement, name: keyof HeadsetSettings): Field {
  return form.elements.namedItem(name) as Field;
}

export function fillHeadsetFields(form: HTMLFormElement, settings: HeadsetSettings): void {
  for (const name of [...CHOICES, ...NUMBERS]) fieldOf(form, name).value = String(settings[name]);
}

export function readHeadsetFields(form: HTMLFormElement): HeadsetSettings {
  const chosen = CHOICES.map((name) => [name, fieldOf(form, name).value] as const);
  const numbers = NUMBERS.map((name) => [name, Number(fieldOf(form, name).value)] as const);
  return parseHeadset(Object.fromEntries([...chosen, ...numbers]));
}
