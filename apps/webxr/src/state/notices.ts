/** Notices to the operator: a line that disappears by itself, and a failure that keeps the page from working. */
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import type { Tone, Words } from '../words/words.ts';

const SHOWN_MS = 5000;

export interface Failure {
  readonly title: string;
  readonly text: string;
}

export class Notices {
  /** What keeps the page from working; `null` if nothing does. */
  readonly failure = signal<Failure | null>(null);
  readonly #last = signal<Words | null>(null);
  readonly #gone = signal(false);
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** The last line told, whether it is still shown or not. */
  readonly last: ReadonlySignal<Words | null> = this.#last;
  readonly shown: ReadonlySignal<Words | null> = computed(() => (this.#gone.value ? null : this.#last.value));

  tell(text: string, tone: Tone = 'neutral'): void {
    this.#last.value = { text, tone };
    this.#gone.value = false;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.#gone.value = true;
    }, SHOWN_MS);
  }
}
