export type TalkControl = 'key' | 'pointer' | 'headset';

/** Whether any of the controls with which an operator speaks is held. */
export class TalkHold {
  readonly #down = new Set<TalkControl>();

  /** @returns whether any is held now */
  set(control: TalkControl, down: boolean): boolean {
    if (down) this.#down.add(control);
    else this.#down.delete(control);
    return this.#down.size > 0;
  }
}
