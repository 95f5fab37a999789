import { parseSignalingUrl } from '@farpoint/operator';
import type { Signal } from '@preact/signals-core';
import { type HeadsetSettings, parseHeadset } from '../../ground/headset-settings.ts';
import { clampScale, ownSignalingUrl } from '../../ground/settings.ts';
import { tokenOrigin, withToken } from '../../ground/signaling-tokens.ts';
import { forgetVisitTokens, loadStored, pageOrigin, store } from '../../ground/stored-settings.ts';
import { parseTileTemplate } from '../../ground/telemetry/map-tiles.ts';
import { elements } from './elements.ts';

/** Sets up the dialog. @param pointScale follows the slider while it moves */
export function initSettingsDialog(pointScale: Signal<number>): void {
  const { settings: dialog, settingsOpen } = elements;
  const form = dialog.querySelector('form')!;
  const field = (name: string): HTMLInputElement => form.elements.namedItem(name) as HTMLInputElement;
  const service = (): ReturnType<typeof parseSignalingUrl> => {
    const value = field('signaling').value.trim();
    if (value === '') return { url: ownSignalingUrl(pageOrigin()) };
    return parseSignalingUrl(value, location.protocol === 'https:');
  };
  /** Shows the token of the service in the field above. */
  const showToken = (): void => {
    const at = service();
    field('token').value = 'url' in at ? (loadStored().tokens?.get(tokenOrigin(at.url)) ?? '') : '';
  };
  let tokenTyped = false;
  settingsOpen.addEventListener('click', () => {
    const stored = loadStored();
    field('signaling').value = stored.signaling ?? '';
    field('name').value = stored.name ?? '';
    field('pointScale').value = String(stored.pointScale ?? 1);
    field('synchronised').checked = stored.synchronised ?? true;
    field('cues').checked = stored.cues ?? true;
    fillHeadsetFields(form, parseHeadset(stored.headset));
    field('mapTiles').value = stored.mapTiles ?? '';
    field('mapAttribution').value = stored.mapAttribution ?? '';
    tokenTyped = false;
    showToken();
    dialog.showModal();
  });
  field('signaling').addEventListener('input', () => {
    const at = service();
    field('signaling').setCustomValidity('fault' in at ? at.fault : '');
    if (!tokenTyped) showToken();
  });
  field('mapTiles').addEventListener('input', () => {
    const text = field('mapTiles').value.trim();
    const parsed = text === '' ? null : parseTileTemplate(text, pageOrigin());
    field('mapTiles').setCustomValidity(parsed !== null && 'fault' in parsed ? parsed.fault : '');
  });
  field('token').addEventListener('input', () => {
    tokenTyped = true;
  });
  field('pointScale').addEventListener('input', () => {
    pointScale.value = Number(field('pointScale').value);
  });
  dialog.addEventListener('close', () => {
    if (dialog.returnValue !== 'save') {
      pointScale.value = clampScale(loadStored().pointScale);
      return;
    }
    save(service());
  });

  function save(at: ReturnType<typeof service>): void {
    const { tokens = new Map() } = loadStored();
    store({
      signaling: field('signaling').value,
      tokens: 'url' in at ? withToken(tokens, tokenOrigin(at.url), field('token').value.trim()) : tokens,
      name: field('name').value,
      pointScale: clampScale(Number(field('pointScale').value)),
      synchronised: field('synchronised').checked,
      cues: field('cues').checked,
      headset: readHeadsetFields(form),
      mapTiles: field('mapTiles').value.trim(),
      mapAttribution: field('mapAttribution').value.trim(),
    });
    forgetVisitTokens();
    // These parameters in the page's address would override what was just saved.
    const address = new URL(location.href);
    for (const name of ['signaling', 'token', 'name', 'sync', 'cues']) address.searchParams.delete(name);
    location.replace(address);
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
