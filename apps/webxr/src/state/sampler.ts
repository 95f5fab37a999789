/**
 * Makes signals of values that are kept elsewhere, e.g. in the client. Each sample reads them again. Time is an
 * argument.
 */
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';

export class Sampler {
  /** A new object for each sample, because two samples may have the same millisecond. */
  readonly #sample = signal({ atMs: 0 });

  /** When the last sample was taken, ms. */
  readonly atMs: ReadonlySignal<number> = computed(() => this.#sample.value.atMs);

  /** Reads again whatever {@link of} was given. @param nowMs `performance.now()` */
  take(nowMs: number): void {
    this.#sample.value = { atMs: nowMs };
  }

  /** A signal of what `read` returns. `read` runs at most once per sample, and only if the signal is read. */
  of<T>(read: (atMs: number) => T): ReadonlySignal<T> {
    return computed(() => read(this.#sample.value.atMs));
  }
}

/** A signal that changes only when the value does. @param source plain data, as JSON can hold it */
export function steady<T>(source: ReadonlySignal<T>): ReadonlySignal<T> {
  let [text, value]: [string | null, T | null] = [null, null];
  return computed(() => {
    const now = source.value;
    const nowText = JSON.stringify(now);
    if (nowText !== text) [text, value] = [nowText, now];
    return value as T;
  });
}
