/** Signals of what is kept elsewhere, e.g. in the client: read anew with each sample. Time is an argument. */
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';

export class Sampler {
  /** A new object each time: two samples may be of the same millisecond. */
  readonly #sample = signal({ atMs: 0 });

  /** When the last sample was taken, ms. */
  readonly atMs: ReadonlySignal<number> = computed(() => this.#sample.value.atMs);

  /** Everything that {@link of} has made is read anew. @param nowMs `performance.now()` */
  take(nowMs: number): void {
    this.#sample.value = { atMs: nowMs };
  }

  /** What `read` gives: called once for each sample, where somebody wants to know. */
  of<T>(read: (atMs: number) => T): ReadonlySignal<T> {
    return computed(() => read(this.#sample.value.atMs));
  }
}
