/** Things of the robot that people switch on and off one by one: its cameras, its sensors. */
import { computed, type ReadonlySignal, type Signal, signal } from '@preact/signals-core';

export interface Switch {
  /** Place in the robot's list. */
  readonly index: number;
  readonly name: string;
  readonly on: ReadonlySignal<boolean>;
}

interface OwnSwitch extends Switch {
  readonly on: Signal<boolean>;
}

export class Switches {
  readonly #all = signal<readonly OwnSwitch[]>([]);
  /** Of whichever robot: what somebody has switched off stays off. */
  readonly #switchedOff = new Set<string>();

  /** Empty where the robot has told of none. */
  readonly all: ReadonlySignal<readonly Switch[]> = this.#all;
  /** The indices of those that are on. A new list whenever `all` is one: another session knows nothing of it. */
  readonly wanted: ReadonlySignal<readonly number[]> = computed(() =>
    this.#all.value.flatMap(({ index, on }) => (on.value ? [index] : [])),
  );

  /** The robot has told of them; with an empty list, a session begins. */
  set(entries: readonly { name: string }[]): void {
    this.#all.value = entries.map(({ name }, index) => ({
      ...{ index, name },
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
