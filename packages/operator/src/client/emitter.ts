/** Typed events. If a listener throws, the others are still called. */
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

  /** @returns whether there are listeners */
  emit<Type extends keyof Events>(type: Type, event: Events[Type]): boolean {
    const listeners = this.#listeners.get(type);
    if (listeners === undefined || listeners.size === 0) return false;
    for (const listener of [...listeners]) {
      try {
        (listener as (event: Events[Type]) => void)(event);
      } catch (error) {
        // Report it as an uncaught error of the page, as browsers do for their own events.
        queueMicrotask(() => {
          throw error;
        });
      }
    }
    return true;
  }
}
