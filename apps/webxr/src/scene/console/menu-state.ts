/** The headset's menu: whether it is open, on which page, and which entry is marked. By ray, by stick or by hand. */
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import type { ConsoleActions } from './console-actions.ts';
import type { MenuItem, MenuPlace } from './menu-item.ts';
import { type MenuFacts, type MenuPage, menuPage } from './menu-page.ts';

/** No entry. */
const NONE = -1;
const NO_ITEMS: readonly MenuItem[] = [];
/**
 * After entries have moved by themselves, nothing is chosen for so long, ms. Chosen: longer than a hand takes from seeing an
 * entry to pulling the trigger; menu-state.test.ts holds it.
 */
const SETTLES_MS = 500;

export class MenuState {
  readonly #place = signal<MenuPlace | null>(null);
  readonly #marked = signal(NONE);
  readonly #actions: ConsoleActions;
  /** Whether a stick has moved the mark since a ray did. */
  #bySteps = false;
  /** What {@link update} has seen: the page, which entries it had, and when they moved by themselves. */
  #seen: MenuPage | null = null;
  #entries = '';
  #movedMs = Number.NEGATIVE_INFINITY;

  readonly isOpen: ReadonlySignal<boolean> = computed(() => this.#place.value !== null);
  /** What it shows; `null` while it is closed. */
  readonly page: ReadonlySignal<MenuPage | null>;
  /** The entry that is marked, from 0; −1: none, before a ray or a stick has marked one. */
  readonly marked: ReadonlySignal<number> = computed(() =>
    Math.min(this.#marked.value, (this.page.value?.items.length ?? 1) - 1),
  );

  constructor(facts: ReadonlySignal<MenuFacts>, actions: ConsoleActions) {
    this.#actions = actions;
    this.page = computed(() => {
      const place = this.#place.value;
      return place === null ? null : menuPage(facts.value, place);
    });
  }

  open(): void {
    this.#bySteps = false;
    this.show({ page: 'main', first: 0 });
  }

  /** Shows a page. Whoever has come to it by the stick goes on by it. */
  show(place: MenuPlace): void {
    this.#place.value = place;
    this.#marked.value = this.#bySteps ? this.#first : NONE;
    this.#seen = this.page.peek();
    this.#entries = entriesOf(this.#items);
  }

  /** Call this before each display frame: notes when entries move. Allocates nothing unless the page has changed. */
  update(nowMs: number): void {
    const page = this.page.peek();
    if (page === this.#seen) return;
    this.#seen = page;
    const entries = entriesOf(this.#items);
    if (page !== null && entries !== this.#entries) this.#movedMs = nowMs;
    this.#entries = entries;
  }

  close(): void {
    this.#place.value = null;
    this.#bySteps = false;
  }

  /** Whether the stick has marked what a trigger chooses. */
  get isBySteps(): boolean {
    return this.#bySteps;
  }

  get #items(): readonly MenuItem[] {
    return this.page.peek()?.items ?? NO_ITEMS;
  }

  /** The first entry that does not stop the robot. */
  get #first(): number {
    return this.#items.findIndex(({ choice, tone }) => choice !== null && tone !== 'bad');
  }

  /** Marks the entry that a ray has come to; −1: it has left the menu, where a mark of the stick stays. */
  mark(row: number): void {
    if (row < 0 && this.#bySteps) return;
    this.#bySteps = false;
    this.#marked.value = this.#items[row]?.choice == null ? NONE : row;
  }

  /** Marks the next entry that can be chosen, or the first one. @param by 1: down, −1: up */
  step(by: 1 | -1): void {
    const items = this.#items;
    this.#bySteps = true;
    let row = this.marked.peek();
    if (row < 0) {
      this.#marked.value = this.#first;
      return;
    }
    for (let tried = 0; tried < items.length; tried++) {
      row = (row + by + items.length) % items.length;
      if (items[row]?.choice !== null) break;
    }
    this.#marked.value = row;
  }

  /**
   * A trigger was pulled or a hand has pinched: does what the entry says.
   *
   * @param row that the ray is at; `null`: at none. After a step of the stick, the marked entry is chosen wherever the ray
   * rests; a ray elsewhere chooses nothing by itself.
   */
  choose(row: number | null, nowMs: number): void {
    this.update(nowMs);
    const chosen = this.#bySteps ? this.marked.peek() : row;
    const item = chosen === null ? undefined : this.#items[chosen];
    const choice = item?.choice ?? null;
    const isStop = item?.tone === 'bad';
    if (choice === null || (!isStop && nowMs - this.#movedMs < SETTLES_MS)) return;
    if ('page' in choice) {
      this.show(choice);
      return;
    }
    if (choice.closes) this.close();
    choice.act(this.#actions);
  }
}

/** What can be chosen, and where. */
function entriesOf(items: readonly MenuItem[]): string {
  return items.map(({ text, choice }) => (choice === null ? '' : text)).join('\n');
}
