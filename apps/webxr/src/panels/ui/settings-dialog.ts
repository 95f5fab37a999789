import { parseSignalingUrl } from '@farpoint/operator';
import type { Signal } from '@preact/signals-core';
import { displaySettings } from '../../ground/display/stored-display.ts';
import { type HeadsetSettings, parseHeadset } from '../../ground/headset-settings.ts';
import type { LiveSettings } from '../../ground/live-settings.ts';
import { clampScale, ownSignalingUrl, type StoredSettings } from '../../ground/settings.ts';
import { needsReload } from '../../ground/settings-change.ts';
import { tokenOrigin, withToken } from '../../ground/signaling-tokens.ts';
import { forgetVisitTokens, loadStored, pageOrigin, store } from '../../ground/stored-settings.ts';
import { parseTileTemplate } from '../../ground/telemetry/map-tiles.ts';
import { language, texts } from '../../words/language.ts';
import { type SaveEffect, saveWords, sliderWords, tileFaultWords } from '../../words/settings-words.ts';
import { addClipField } from './clip-field.ts';
import { initDisplayFields } from './display-fields.ts';
import { elements } from './elements.ts';
import { openDialog } from './open-dialog.ts';
import { wantedLanguage } from './wanted-language.ts';

/**
 * Sets up the dialog.
 *
 * @param pointScale follows the slider while it moves
 * @param live takes over what counts at once
 */
export function initSettingsDialog(pointScale: Signal<number>, live: Pick<LiveSettings, 'apply'>): void {
  const { settings: dialog, settingsOpen } = elements;
  const element = dialog.querySelector('form')!;
  addClipField(element, 'cues');
  const form = new SettingsForm(element);
  initDisplayFields(element, displaySettings);
  let display = displaySettings.peek();
  settingsOpen.addEventListener('click', () => {
    form.fill();
    display = displaySettings.peek();
    openDialog(dialog);
  });
  // No submit button: Enter in a field saves.
  element.querySelector('[value="cancel"]')?.addEventListener('click', () => dialog.close('cancel'));
  form.listen(pointScale);
  // At once: a dialog tells that it was closed only in a later task, and a key may come before.
  element.addEventListener('submit', () => form.save(live));
  dialog.addEventListener('close', () => {
    if (dialog.returnValue === 'save') return;
    pointScale.value = clampScale(loadStored().pointScale);
    displaySettings.value = display;
  });
}

/** The fields of the dialog. */
class SettingsForm {
  readonly #form: HTMLFormElement;
  #tokenTyped = false;
  /** What the fields held when the dialog was opened. */
  #before: StoredSettings = {};

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
    this.#field('clips').checked = stored.clips ?? false;
    fillHeadsetFields(this.#form, parseHeadset(stored.headset));
    this.#field('mapTiles').value = stored.mapTiles ?? '';
    this.#field('mapAttribution').value = stored.mapAttribution ?? '';
    this.#tokenTyped = false;
    this.#showToken();
    this.#before = this.#read();
    this.#describe();
  }

  /** Checks fields while they change. */
  listen(pointScale: Signal<number>): void {
    this.#field('signaling').addEventListener('input', () => {
      const at = this.#service();
      const typed = this.#field('signaling').value.trim();
      this.#field('signaling').setCustomValidity(
        'reason' in at ? texts().settings.addressFaults[at.reason](typed) : '',
      );
      if (!this.#tokenTyped) this.#showToken();
    });
    this.#field('mapTiles').addEventListener('input', () => {
      const text = this.#field('mapTiles').value.trim();
      const parsed = text === '' ? null : parseTileTemplate(text, pageOrigin());
      const isWrong = parsed !== null && 'fault' in parsed;
      this.#field('mapTiles').setCustomValidity(isWrong ? tileFaultWords(parsed.fault) : '');
    });
    this.#field('token').addEventListener('input', () => {
      this.#tokenTyped = true;
    });
    this.#field('pointScale').addEventListener('input', () => {
      pointScale.value = Number(this.#field('pointScale').value);
    });
    // The display's settings take a choice with `change` only.
    for (const change of ['input', 'change']) this.#form.addEventListener(change, () => this.#describe());
  }

  /** Stores what is in the fields. Only for a new connection or another language, the page is loaded again. */
  save(live: Pick<LiveSettings, 'apply'>): void {
    const settings = this.#read();
    store(settings);
    live.apply(settings);
    const { reconnects, reloads } = this.#effectOf(settings);
    if (reloads && !reconnects) location.reload();
    if (!reconnects) return;
    forgetVisitTokens();
    // These parameters in the page's address would override what was just saved.
    const address = new URL(location.href);
    for (const name of ['signaling', 'token', 'name']) address.searchParams.delete(name);
    location.replace(address);
  }

  #read(): StoredSettings {
    const at = this.#service();
    const { tokens = new Map() } = loadStored();
    const token = this.#field('token').value.trim();
    return {
      signaling: this.#field('signaling').value,
      tokens: 'url' in at ? withToken(tokens, tokenOrigin(at.url), token) : tokens,
      name: this.#field('name').value,
      pointScale: clampScale(Number(this.#field('pointScale').value)),
      synchronised: this.#field('synchronised').checked,
      cues: this.#field('cues').checked,
      clips: this.#field('clips').checked,
      headset: readHeadsetFields(this.#form),
      mapTiles: this.#field('mapTiles').value.trim(),
      mapAttribution: this.#field('mapAttribution').value.trim(),
    };
  }

  /** Writes the sliders' values, and what the button does. */
  #describe(): void {
    for (const output of this.#form.querySelectorAll('output')) {
      const name = output.htmlFor.value.replace('settings-', '');
      output.value = sliderWords[name]?.(Number(this.#field(name).value)) ?? '';
    }
    elements.settingsSave.textContent = saveWords(this.#effectOf(this.#read()));
  }

  /** What keeping these settings does to the page. */
  #effectOf(settings: StoredSettings): SaveEffect {
    return {
      reconnects: needsReload(this.#before, settings),
      reloads: wantedLanguage() !== language(),
    };
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
