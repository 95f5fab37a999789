/** The frame of a tile: its title, and the buttons that arrange it. Draws the tile only while it can be seen. */
import { quietButton } from '../ui/panel-parts.ts';
import type { TileSize } from './layout.ts';
import { part, setText, type Tile, type TileFrame } from './tile.ts';

export interface TileActions {
  move(by: -1 | 1): void;
  /** To the next size. */
  resize(): void;
  hide(): void;
}

export interface ShownTile {
  readonly title: string;
  readonly size: TileSize;
  /** Whether the buttons are shown. */
  readonly arranging: boolean;
}

export class TileFrameView {
  readonly element = document.createElement('section');
  readonly #tile: Tile;
  readonly #title = document.createElement('h3');
  readonly #buttons = part('arrange');
  readonly #watching: IntersectionObserver;
  #named: readonly (readonly [HTMLButtonElement, string])[];
  #inView = true;
  #dueMs = 0;

  constructor(tile: Tile, { move, resize, hide }: TileActions) {
    this.#tile = tile;
    this.element.className = 'tile';
    this.#named = [
      [quietButton('◀', 'Earlier', () => move(-1)), 'Move earlier: '],
      [quietButton('▶', 'Later', () => move(1)), 'Move later: '],
      [quietButton('⤢', 'Size', resize), 'Change the size: '],
      [quietButton('✕', 'Hide', hide), 'Hide: '],
    ];
    this.#buttons.append(...this.#named.map(([button]) => button));
    const head = part('head');
    head.append(this.#title, this.#buttons);
    this.element.append(head, tile.element);
    this.#watching = new IntersectionObserver(([entry]) => {
      this.#inView = entry?.isIntersecting ?? true;
    });
    this.#watching.observe(this.element);
  }

  show({ title, size, arranging }: ShownTile): void {
    setText(this.#title, title);
    this.element.ariaLabel = title;
    this.element.dataset.size = size;
    this.#buttons.hidden = !arranging;
    for (const [button, words] of this.#named) button.ariaLabel = words + title;
    this.#dueMs = 0;
  }

  draw(frame: TileFrame): void {
    if (!this.#inView || frame.nowMs < this.#dueMs) return;
    this.#dueMs = frame.nowMs + this.#tile.everyMs(frame);
    this.#tile.update(frame);
  }

  dispose(): void {
    this.#watching.disconnect();
    this.#tile.dispose();
    this.element.remove();
  }
}
