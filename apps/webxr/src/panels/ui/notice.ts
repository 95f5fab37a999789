/** Shows the notice line, and the panel that says why the page does not work. */
import { effect } from '@preact/signals-core';
import type { Notices } from '../../state/notices.ts';
import { elements } from './elements.ts';

export function showNotices({ shown, failure }: Notices): void {
  effect(() => {
    const { notice } = elements;
    notice.hidden = shown.value === null;
    if (shown.value === null) return;
    notice.textContent = shown.value.text;
    notice.dataset.tone = shown.value.tone;
  });
  effect(() => {
    const { failure: panel } = elements;
    panel.hidden = failure.value === null;
    if (failure.value === null) return;
    panel.querySelector('h1')!.textContent = failure.value.title;
    panel.querySelector('p')!.textContent = failure.value.text;
  });
}
