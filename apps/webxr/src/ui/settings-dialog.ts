import { clampScale, parseSignalingUrl, parseStored, type StoredSettings } from '../settings.ts';
import { elements } from './elements.ts';

const KEY = 'farpoint.settings';

/** What this browser remembers; nothing where it may not. */
export function loadStored(): StoredSettings {
  try {
    return parseStored(localStorage.getItem(KEY));
  } catch {
    return {};
  }
}

function store(settings: StoredSettings): void {
  try {
    localStorage.setItem(KEY, JSON.stringify(settings));
  } catch {
    // Private browsing: the settings hold for this visit by the address only.
  }
}

/** Wires the dialog. @param onPointScale while the slider moves */
export function initSettingsDialog(onPointScale: (scale: number) => void): void {
  const { settings: dialog, settingsOpen } = elements;
  const form = dialog.querySelector('form')!;
  const field = (name: string): HTMLInputElement => form.elements.namedItem(name) as HTMLInputElement;
  settingsOpen.addEventListener('click', () => {
    const stored = loadStored();
    field('signaling').value = stored.signaling ?? '';
    field('token').value = stored.token ?? '';
    field('name').value = stored.name ?? '';
    field('pointScale').value = String(stored.pointScale ?? 1);
    dialog.showModal();
  });
  field('signaling').addEventListener('input', () => {
    const { value } = field('signaling');
    const parsed =
      value.trim() === '' ? null : parseSignalingUrl(value.trim(), location.protocol === 'https:');
    field('signaling').setCustomValidity(parsed !== null && 'fault' in parsed ? parsed.fault : '');
  });
  field('pointScale').addEventListener('input', () => onPointScale(Number(field('pointScale').value)));
  dialog.addEventListener('close', () => {
    if (dialog.returnValue !== 'save') {
      onPointScale(clampScale(loadStored().pointScale));
      return;
    }
    store({
      signaling: field('signaling').value,
      token: field('token').value,
      name: field('name').value,
      pointScale: clampScale(Number(field('pointScale').value)),
    });
    // What the address says would hide what was just saved.
    const address = new URL(location.href);
    for (const name of ['signaling', 'token', 'name']) address.searchParams.delete(name);
    location.replace(address);
  });
}
