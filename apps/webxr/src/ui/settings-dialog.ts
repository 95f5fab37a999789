import { parseSignalingUrl } from '@farpoint/operator';
import type { Signal } from '@preact/signals-core';
import { displaySettings } from '../display/stored-display.ts';
import { parseHeadset } from '../headset/headset-settings.ts';
import type { LiveSettings } from '../live-settings.ts';
import { clampScale, ownSignalingUrl, type StoredSettings } from '../settings.ts';
import { needsReload } from '../settings-change.ts';
import { tokenOrigin, withToken } from '../signaling-tokens.ts';
import { saveWords, sliderWords } from '../status/settings-words.ts';
import { forgetVisitTokens, loadStored, pageOrigin, store } from '../stored-settings.ts';
import { parseTileTemplate } from '../telemetry/map-tiles.ts';
import { initDisplayFields } from './display-fields.ts';
import { elements } from './elements.ts';
import { fillHeadsetFields, readHeadsetFields } from './headset-fields.ts';
import { openDialog } from './open-dialog.ts';

/** The page's address would otherwise override what was saved. */
const LIVE_PARAMETERS = ['sync', 'cues', 'clips'];
const PARAMETERS = ['signaling', 'token', 'name', ...LIVE_PARAMETERS];

/**
 * Sets up the dialog.
 *
 * @param pointScale follows the slider while it moves
 * @param live take over what counts at once
 */
export function initSettingsDialog(pointScale: Signal<number>, live: Pick<LiveSettings, 'apply'>): void {
  const { settings: dialog, settingsOpen, settingsReset, settingsSave } = elements;
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
  initDisplayFields(form, displaySettings);
  let tokenTyped = false;
  /** What the fields hold. */
  const read = (): StoredSettings => {
    const at = service();
    const { tokens = new Map() } = loadStored();
    return {
      signaling: field('signaling').value,
      tokens: 'url' in at ? withToken(tokens, tokenOrigin(at.url), field('token').value.trim()) : tokens,
      name: field('name').value,
      pointScale: clampScale(Number(field('pointScale').value)),
      synchronised: field('synchronised').checked,
      cues: field('cues').checked,
      clips: field('clips').checked,
      headset: readHeadsetFields(form),
      mapTiles: field('mapTiles').value.trim(),
      mapAttribution: field('mapAttribution').value.trim(),
    };
  };
  /** How everything looks and sounds, as it was at the first visit if `stored` is empty. */
  const fillLook = (stored: StoredSettings): void => {
    field('pointScale').value = String(stored.pointScale ?? 1);
    field('synchronised').checked = stored.synchronised ?? true;
    field('cues').checked = stored.cues ?? true;
    field('clips').checked = stored.clips ?? false;
    fillHeadsetFields(form, parseHeadset(stored.headset));
    field('mapTiles').value = stored.mapTiles ?? '';
    field('mapAttribution').value = stored.mapAttribution ?? '';
  };
  let before: StoredSettings = {};
  const follow = (): void => {
    pointScale.value = clampScale(Number(field('pointScale').value));
    for (const output of form.querySelectorAll<HTMLOutputElement>('output'))
      output.value = sliderWords[output.dataset.of ?? '']?.(Number(field(output.htmlFor.value).value)) ?? '';
    settingsSave.textContent = saveWords(needsReload(before, read()));
  };
  settingsOpen.addEventListener('click', () => {
    const stored = loadStored();
    field('signaling').value = stored.signaling ?? '';
    field('name').value = stored.name ?? '';
    fillLook(stored);
    tokenTyped = false;
    showToken();
    before = read();
    follow();
    openDialog(dialog);
  });
  settingsReset.addEventListener('click', () => {
    fillLook({});
    follow();
  });
  form.addEventListener('input', follow);
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
  dialog.addEventListener('close', () => {
    if (dialog.returnValue !== 'save') {
      pointScale.value = clampScale(loadStored().pointScale);
      return;
    }
    const settings = read();
    const reloads = needsReload(before, settings);
    store(settings);
    const address = new URL(location.href);
    for (const name of reloads ? PARAMETERS : LIVE_PARAMETERS) address.searchParams.delete(name);
    if (!reloads) {
      live.apply(settings);
      history.replaceState(null, '', address);
      return;
    }
    forgetVisitTokens();
    location.replace(address);
  });
}
