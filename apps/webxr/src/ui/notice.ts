/** What a person must know now: one line that goes by itself. */
import type { Tone } from '../status/words.ts';
import { elements } from './elements.ts';

const SHOWN_MS = 5000;
let timer: ReturnType<typeof setTimeout> | undefined;
let last: string | null = null;

export function notify(text: string, tone: Tone = 'neutral'): void {
  const { notice } = elements;
  last = text;
  notice.textContent = text;
  notice.dataset.tone = tone;
  notice.hidden = false;
  clearTimeout(timer);
  timer = setTimeout(() => {
    notice.hidden = true;
  }, SHOWN_MS);
}

/** The last line told, shown or gone. */
export function lastNotice(): string | null {
  return last;
}

/** What keeps the page from working at all. */
export function showFailure(failure: { title: string; text: string } | null): void {
  const { failure: panel } = elements;
  panel.hidden = failure === null;
  if (failure === null) return;
  panel.querySelector('h1')!.textContent = failure.title;
  panel.querySelector('p')!.textContent = failure.text;
}
