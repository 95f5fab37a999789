/** Typed events. A listener that throws does not keep the others from being called. */
export class Emitter<Events extends object> {
  readonly #listeners = new Map<keyof Events, Set<(event: never) => void>>();

  /** @returns a function that removes the listener */
  on<Type extends keyof Events>(type: Type, listener: (event: Events[Type]) => void): () => void {
    let listeners = this.#listeners.get(type);
    if (listeners === undefined) {
      listeners = new Set();
      this.#listeners.set(type, listeners);
    }
    listeners.add(listener);
    return () => listeners.delete(listener);
  }

  /** @returns whether anybody listens */
  emit<Type extends keyof Events>(type: Type, event: Events[Type]): boolean {
    const listeners = this.#listeners.get(type);
    if (listeners === undefined || listeners.size === 0) return false;
    for (const listener of [...listeners]) {
      try {
        (listener as (event: Events[Type]) => void)(event);
      } catch (error) {
        // Reported as an error of the page's own, as for events of the browser.
        queueMicrotask(() => {
          throw error;
        });
      }
    }
    return true;
  }
}
