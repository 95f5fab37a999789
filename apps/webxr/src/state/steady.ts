/** Signals of values that are made anew with each sample, although they seldom change. */
import { computed, type ReadonlySignal } from '@preact/signals-core';

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
