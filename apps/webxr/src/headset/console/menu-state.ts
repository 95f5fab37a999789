/** The headset's menu: whether it is open, on which page, and what is marked. By ray, by stick or by hand. */
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import type { ConsoleActions } from './console-actions.ts';
import { type MenuFacts, type MenuPage, type MenuPageName, menuPage } from './menu-page.ts';

export class MenuState {
  readonly #open = signal<{ page: MenuPageName; first: number } | null>(null);
  readonly #marked = signal(0);
  readonly #actions: ConsoleActions;

  readonly isOpen: ReadonlySignal<boolean> = computed(() => this.#open.value !== null);
  /** What it shows; `null` while it is closed. */
  readonly page: ReadonlySignal<MenuPage | null>;
  /** Row that is marked, from 0. */
  readonly marked: ReadonlySignal<number> = computed(() =>
    Math.min(this.#marked.value, (this.page.value?.items.length ?? 1) - 1),
  );

  constructor(facts: ReadonlySignal<Omit<MenuFacts, 'page' | 'first'>>, actions: ConsoleActions) {
    this.#actions = actions;
    this.page = computed(() => {
      const open = this.#open.value;
      return open === null ? null : menuPage({ ...facts.value, ...open });
    });
  }

  open(page: MenuPageName, first = 0): void {
    this.#open.value = { page, first };
    this.#marked.value = this.#first();
  }

  close(): void {
    this.#open.value = null;
  }

  /** Marks the row that is pointed at. */
  mark(row: number): void {
    const items = this.page.peek()?.items;
    if (items?.[row]?.choice != null) this.#marked.value = row;
  }

  /** Marks the next row that can be chosen. @param by 1: down, −1: up */
  step(by: 1 | -1): void {
    const items = this.page.peek()?.items ?? [];
    let row = this.marked.peek();
    for (let tried = 0; tried < items.length; tried++) {
      row = (row + by + items.length) % items.length;
      if (items[row]?.choice !== null) break;
    }
    this.#marked.value = row;
  }

  /** Does what a row says: the marked one unless another is given. */
  choose(row = this.marked.peek()): void {
    const choice = this.page.peek()?.items[row]?.choice ?? null;
    if (choice === null) return;
    if ('open' in choice) {
      this.open(choice.open, choice.first);
      return;
    }
    if (choice.closes) this.close();
    choice.do(this.#actions);
  }

  /** The first row that can be chosen without stopping the robot. */
  #first(): number {
    const items = this.page.peek()?.items ?? [];
    const first = items.findIndex(({ choice, tone }) => choice !== null && tone !== 'bad');
    return Math.max(first, 0);
  }
}
