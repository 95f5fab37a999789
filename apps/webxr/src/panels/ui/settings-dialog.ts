import { parseSignalingUrl } from '@farpoint/operator';
import type { Signal } from '@preact/signals-core';
import { type HeadsetSettings, parseHeadset } from '../../ground/headset-settings.ts';
import { clampScale, ownSignalingUrl } from '../../ground/settings.ts';
import { tokenOrigin, withToken } from '../../ground/signaling-tokens.ts';
import { forgetVisitTokens, loadStored, pageOrigin, store } from '../../ground/stored-settings.ts';
import { parseTileTemplate } from '../../ground/telemetry/map-tiles.ts';
import { elements } from './elements.ts';
import { openDialog } from './open-dialog.ts';

/** Sets up the dialog. @param pointScale follows the slider while it moves */
export function initSettingsDialog(pointScale: Signal<number>): void {
  const { settings: dialog, settingsOpen } = elements;
  const form = new SettingsForm(dialog.querySelector('form')!);
  settingsOpen.addEventListener('click', () => {
    form.fill();
    openDialog(dialog);
  });
  form.listen(pointScale);
  dialog.addEventListener('close', () => {
    if (dialog.returnValue === 'save') form.save();
    else pointScale.value = clampScale(loadStored().pointScale);
  });
}

/** The fields of the dialog. */
class SettingsForm {
  readonly #form: HTMLFormElement;
  #tokenTyped = false;

  constructor(form: HTMLFormElement) {
    this.#form = form;
  }

  /** Writes the stored settings into the fields. */
  fill(): void {
    const stored = loadStored();
    this.#field('signaling').value = stored.signaling ?? '';
    this.#field('name').value = stored.name ?? '';
    this.#field('pointScale').value = String(stored.pointScale ?? 1);
    this.#field('synchronised').checked = stored.synchronised ?? true;
    this.#field('cues').checked = stored.cues ?? true;
    fillHeadsetFields(this.#form, parseHeadset(stored.headset));
    this.#field('mapTiles').value = stored.mapTiles ?? '';
    this.#field('mapAttribution').value = stored.mapAttribution ?? '';
    this.#tokenTyped = false;
    this.#showToken();
  }

  /** Checks fields while they change. */
  listen(pointScale: Signal<number>): void {
    this.#field('signaling').addEventListener('input', () => {
      const at = this.#service();
      this.#field('signaling').setCustomValidity('fault' in at ? at.fault : '');
      if (!this.#tokenTyped) this.#showToken();
    });
    this.#field('mapTiles').addEventListener('input', () => {
      const text = this.#field('mapTiles').value.trim();
      const parsed = text === '' ? null : parseTileTemplate(text, pageOrigin());
      this.#field('mapTiles').setCustomValidity(parsed !== null && 'fault' in parsed ? parsed.fault : '');
    });
    this.#field('token').addEventListener('input', () => {
      this.#tokenTyped = true;
    });
    this.#field('pointScale').addEventListener('input', () => {
      pointScale.value = Number(this.#field('pointScale').value);
    });
  }

  /** Stores what is in the fields, and loads the page again. */
  save(): void {
    const at = this.#service();
    const { tokens = new Map() } = loadStored();
    const token = this.#field('token').value.trim();
    store({
      signaling: this.#field('signaling').value,
      tokens: 'url' in at ? withToken(tokens, tokenOrigin(at.url), token) : tokens,
      name: this.#field('name').value,
      pointScale: clampScale(Number(this.#field('pointScale').value)),
      synchronised: this.#field('synchronised').checked,
      cues: this.#field('cues').checked,
      headset: readHeadsetFields(this.#form),
      mapTiles: this.#field('mapTiles').value.trim(),
      mapAttribution: this.#field('mapAttribution').value.trim(),
    });
    forgetVisitTokens();
    // These parameters in the page's address would override what was just saved.
    const address = new URL(location.href);
    for (const name of ['signaling', 'token', 'name']) address.searchParams.delete(name);
    location.replace(address);
  }

  #field(name: string): HTMLInputElement {
    return this.#form.elements.namedItem(name) as HTMLInputElement;
  }

  #service(): ReturnType<typeof parseSignalingUrl> {
    const value = this.#field('signaling').value.trim();
    if (value === '') return { url: ownSignalingUrl(pageOrigin()) };
    return parseSignalingUrl(value, location.protocol === 'https:');
  }

  /** Shows the token of the service in the field above. */
  #showToken(): void {
    const at = this.#service();
    this.#field('token').value = 'url' in at ? (loadStored().tokens?.get(tokenOrigin(at.url)) ?? '') : '';
  }
}

const CHOICES = ['turn', 'posture', 'driveHand'] as const;
const NUMBERS = ['snapDegrees', 'vignette', 'frameRate', 'foveation', 'resolution'] as const;

type Field = HTMLInputElement | HTMLSelectElement;

function fieldOf(form: HTMLFormElement, name: keyof HeadsetSettings): Field {
  return form.elements.namedItem(name) as Field;
}

/** The headset’s part of the settings dialog. */
function fillHeadsetFields(form: HTMLFormElement, settings: HeadsetSettings): void {
  for (const name of [...CHOICES, ...NUMBERS]) fieldOf(form, name).value = String(settings[name]);
}

function readHeadsetFields(form: HTMLFormElement): HeadsetSettings {
  const chosen = CHOICES.map((name) => [name, fieldOf(form, name).value] as const);
  const numbers = NUMBERS.map((name) => [name, Number(fieldOf(form, name).value)] as const);
  return parseHeadset(Object.fromEntries([...chosen, ...numbers]));
}
