/** The box of the settings dialog that says whether the last 30 seconds are kept for a clip, and what that costs. */
import { effect } from '@preact/signals-core';
import { texts } from '../../words/language.ts';

/**
 * Puts the box after another field.
 *
 * @param form of the settings
 * @param after name of the field before it
 */
export function addClipField(form: HTMLFormElement, after: string): void {
  const label = document.createElement('label');
  label.className = 'check';
  const box = document.createElement('input');
  box.type = 'checkbox';
  box.name = 'clips';
  const hint = document.createElement('p');
  hint.id = 'settings-clips-hint';
  hint.className = 'hint small';
  box.setAttribute('aria-describedby', hint.id);
  const name = document.createElement('span');
  label.append(box, name);
  effect(() => {
    const { keep, keepHint } = texts().capture;
    name.textContent = keep;
    hint.textContent = keepHint;
  });
  form.querySelector(`label:has([name="${after}"])`)?.after(label, hint);
}
