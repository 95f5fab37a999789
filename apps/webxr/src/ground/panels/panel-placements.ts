/** Where operators have put panels, by the panels' names. A panel without a placement is in its usual place. */
import { type ReadonlySignal, signal } from '@preact/signals-core';
import type { Placement } from './panel-layout.ts';

/** In the order in which the panels were touched: the last is on top. */
export type Placements = ReadonlyMap<string, Placement>;

/** More than a robot has cameras, because every robot's are kept. */
export const MOST_PLACEMENTS = 64;

export class PanelPlacements {
  readonly #all;
  readonly #store: (placements: Placements) => void;
  readonly all: ReadonlySignal<Placements>;

  /** @param store called with each change that is to last */
  constructor(stored: Placements, store: (placements: Placements) => void) {
    this.#all = signal(stored);
    this.all = this.#all;
    this.#store = store;
  }

  /** Puts the panel there, on top of the others. @param lasting `false` while it is still being dragged */
  place(name: string, placement: Placement, lasting = true): void {
    const others = [...this.#all.peek()].filter(([other]) => other !== name);
    this.#all.value = new Map([...others, [name, placement] as const].slice(-MOST_PLACEMENTS));
    if (lasting) this.#store(this.#all.peek());
  }

  /** Puts the panel on top of the others, if it is not in its usual place. */
  raise(name: string): void {
    const placement = this.#all.peek().get(name);
    if (placement === undefined || [...this.#all.peek().keys()].at(-1) === name) return;
    this.place(name, placement);
  }

  /** Puts all panels into their usual places. */
  reset(): void {
    this.#all.value = new Map();
    this.#store(this.#all.peek());
  }
}
