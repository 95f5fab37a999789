/** Moves and resizes panels: by their title and corner with a pointer, by keys when they have the focus. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import {
  type Box,
  boxOf,
  moved,
  type PanelShape,
  type Placement,
  resized,
} from '../../ground/panels/panel-layout.ts';
import type { PanelPlacements } from '../../ground/panels/panel-placements.ts';
import { texts } from '../../words/language.ts';

/** How far a press of an arrow moves a panel, and how much + and − change it, CSS pixels. Chosen by hand. */
const KEY_STEP = 24;
const MOVES: Readonly<Record<string, readonly [dx: number, dy: number]>> = {
  ArrowLeft: [-KEY_STEP, 0],
  ArrowRight: [KEY_STEP, 0],
  ArrowUp: [0, -KEY_STEP],
  ArrowDown: [0, KEY_STEP],
};
const SIZES: Readonly<Record<string, number>> = { '+': KEY_STEP, '=': KEY_STEP, '-': -KEY_STEP };

export interface MovablePanel {
  /** By which its place is kept. */
  readonly name: string;
  readonly figure: HTMLElement;
  readonly title: HTMLElement;
  /** What is shown in it now. */
  readonly picture: () => HTMLCanvasElement;
}

export interface PanelMoverParts {
  readonly placements: PanelPlacements;
  /** `null` while panels stay in their usual places. */
  readonly area: ReadonlySignal<Box | null>;
  /** Whether a grip is held, so that the arrow keys drive. */
  isGripped(): boolean;
}

export class PanelMover {
  readonly #parts: PanelMoverParts;

  constructor(parts: PanelMoverParts) {
    this.#parts = parts;
  }

  /** Makes the panel movable. Call it once for each. */
  attach(panel: MovablePanel): void {
    const { figure, title, name } = panel;
    figure.tabIndex = 0;
    figure.dataset.panel = name;
    const corner = document.createElement('div');
    corner.className = 'corner';
    corner.title = texts().clouds.resize;
    figure.append(corner);
    this.#drag(title, panel, (box, dx, dy, area) => moved(box, dx, dy, area));
    this.#drag(corner, panel, (box, dx, _, area) => resized(box, shapeOf(panel), dx, area));
    figure.addEventListener('pointerdown', () => this.#parts.placements.raise(name));
    figure.addEventListener('keydown', (event) => this.#onKey(event, panel));
  }

  /** Draws the panels where they are to be. Call it within an effect. */
  apply(panels: readonly MovablePanel[], isElsewhere: (panel: MovablePanel) => boolean): void {
    const area = this.#parts.area.value;
    const placements = this.#parts.placements.all.value;
    const order = [...placements.keys()];
    for (const panel of panels) {
      const placement = placements.get(panel.name);
      const floats = area !== null && placement !== undefined && !isElsewhere(panel);
      const { figure } = panel;
      figure.dataset.floating = String(floats);
      if (!floats) {
        if (figure.style.cssText !== '') figure.style.cssText = '';
        continue;
      }
      const { left, top, width } = boxOf(placement, shapeOf(panel), area);
      Object.assign(figure.style, {
        left: `${left}px`,
        top: `${top}px`,
        width: `${width}px`,
        zIndex: String(order.indexOf(panel.name) + 1),
      });
    }
  }

  #drag(
    handle: HTMLElement,
    panel: MovablePanel,
    place: (box: Box, dx: number, dy: number, area: Box) => Placement,
  ): void {
    let from: { readonly box: Box; readonly x: number; readonly y: number } | null = null;
    let to: Placement | null = null;
    handle.addEventListener('pointerdown', (event) => {
      const onButton = event.target instanceof Element && event.target.closest('button') !== null;
      if (this.#parts.area.peek() === null || event.button !== 0 || onButton) return;
      handle.setPointerCapture(event.pointerId);
      const { left, top, width, height } = panel.figure.getBoundingClientRect();
      from = { box: { left, top, width, height }, x: event.clientX, y: event.clientY };
      to = null;
    });
    handle.addEventListener('pointermove', ({ clientX, clientY }) => {
      const area = this.#parts.area.peek();
      if (from === null || area === null) return;
      to = place(from.box, clientX - from.x, clientY - from.y, area);
      this.#parts.placements.place(panel.name, to, false);
    });
    for (const end of ['pointerup', 'pointercancel'] as const) {
      handle.addEventListener(end, () => {
        if (from !== null && to !== null) this.#parts.placements.place(panel.name, to);
        from = null;
      });
    }
  }

  #onKey(event: KeyboardEvent, panel: MovablePanel): void {
    const area = this.#parts.area.peek();
    // Keys of a button or slider within the panel are its own.
    if (area === null || event.target !== panel.figure || this.#parts.isGripped()) return;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === 'Escape') panel.figure.blur();
    const { left, top, width, height } = panel.figure.getBoundingClientRect();
    const box: Box = { left, top, width, height };
    const step = MOVES[event.key];
    const by = SIZES[event.key];
    if (step !== undefined) this.#parts.placements.place(panel.name, moved(box, ...step, area));
    else if (by !== undefined)
      this.#parts.placements.place(panel.name, resized(box, shapeOf(panel), by, area));
    else return;
    event.preventDefault();
  }
}

function shapeOf({ figure, picture }: MovablePanel): PanelShape {
  const { width, height } = picture().getBoundingClientRect();
  const whole = figure.getBoundingClientRect();
  const isShown = width > 0 && height > 0;
  return {
    aspect: isShown ? width / height : null,
    besides: whole.height - height,
    border: isShown ? whole.width - width : 0,
  };
}

/** Keeps a button in step with whether any panel was moved. */
export function showResetButton(button: HTMLElement, { placements, area }: PanelMoverParts): void {
  button.addEventListener('click', () => placements.reset());
  effect(() => {
    button.hidden = area.value === null || placements.all.value.size === 0;
  });
}
