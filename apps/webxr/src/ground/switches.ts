/** Parts of the robot that people switch on and off one by one: its cameras or its sensors. */
import { computed, type ReadonlySignal, type Signal, signal } from '@preact/signals-core';

export interface Switch {
  /** Index in the robot's list. */
  readonly index: number;
  readonly name: string;
  readonly on: ReadonlySignal<boolean>;
}

interface OwnSwitch extends Switch {
  readonly on: Signal<boolean>;
}

export class Switches {
  readonly #all = signal<readonly OwnSwitch[]>([]);
  /** Names that somebody has switched off. They stay off with every robot. */
  readonly #switchedOff = new Set<string>();

  /** Empty until the robot has listed them. */
  readonly all: ReadonlySignal<readonly Switch[]> = this.#all;
  /** The indices of those that are on. A new array whenever `all` is new, because a new session must be told again. */
  readonly wanted: ReadonlySignal<readonly number[]> = computed(() =>
    this.#all.value.flatMap(({ index, on }) => (on.value ? [index] : [])),
  );

  /** Takes the robot's list. An empty list begins a session. */
  set(entries: readonly { name: string }[]): void {
    this.#all.value = entries.map(({ name }, index) => ({
      index,
      name,
      on: signal(!this.#switchedOff.has(name)),
    }));
  }

  toggle(index: number): void {
    const entry = this.#all.peek()[index];
    if (entry === undefined) return;
    const on = !entry.on.peek();
    if (on) this.#switchedOff.delete(entry.name);
    else this.#switchedOff.add(entry.name);
    entry.on.value = on;
  }
}
