/** One way through the signaling service, ms. */
const DELAY_MS = 20;

/** The signaling service: passes messages on while it is there. */
export class Signaling {
  readonly #listeners = new Set<(ready: boolean) => void>();
  #ready = true;

  get ready(): boolean {
    return this.#ready;
  }

  /** Whether the service is there. */
  set ready(ready: boolean) {
    if (ready === this.#ready) return;
    this.#ready = ready;
    for (const listener of this.#listeners) listener(ready);
  }

  onReady(listener: (ready: boolean) => void): void {
    this.#listeners.add(listener);
  }

  /** A message that the other side takes a moment later; lost if the service is away by then. */
  post(take: () => void): void {
    if (!this.#ready) return;
    setTimeout(() => {
      if (this.#ready) take();
    }, DELAY_MS);
  }
}
