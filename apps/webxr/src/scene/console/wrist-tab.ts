/** STOP and the menu below the panel on the wrist, for a hand that points: bare, or with a controller. */
import { effect } from '@preact/signals-core';
import type { Mesh } from 'three';
import { laterTexts } from '../../words/language.ts';
import { PLATE_ORDER, TextPlate } from '../headset/text-plate.ts';

/** As wide as the panel, m; pixels. Chosen: each half is 4 cm high, which a ray from a hand hits without aiming. */
const WIDTH_M = 0.18;
const WIDTH = 512;
const HEIGHT = 114;
const GAP = 12;
/** Of the font, pixels. Chosen: letters like those of a menu at arm's length. */
const SIZE = 46;

export class WristTab {
  readonly #plate = new TextPlate({
    width: WIDTH,
    height: HEIGHT,
    pixelsPerMetre: WIDTH / WIDTH_M,
    order: PLATE_ORDER.wrist,
  });

  constructor() {
    effect(() => this.#draw());
  }

  /** Its origin is in the middle of its upper edge. */
  get sheet(): Mesh {
    return this.#plate.mesh;
  }

  /** The middle of each half is so far from the middle, m. */
  readonly quarterM = WIDTH_M / 4;

  /** @param u of the hit, 0 at the left edge */
  partAt(u: number): 'stop' | 'menu' {
    return u < 0.5 ? 'stop' : 'menu';
  }

  #draw(): void {
    const { stop, menu } = laterTexts().headsetMenu.tab;
    const half = (WIDTH - GAP) / 2;
    this.#plate.draw(HEIGHT, (context) => {
      context.font = `700 ${SIZE}px system-ui, sans-serif`;
      context.textAlign = 'center';
      context.textBaseline = 'middle';
      for (const [at, colour, text] of [
        [0, '#a3222a', stop],
        [half + GAP, '#1b2833', menu],
      ] as const) {
        context.fillStyle = colour;
        context.beginPath();
        context.roundRect(at, 0, half, HEIGHT, 20);
        context.fill();
        context.fillStyle = '#ffffff';
        context.fillText(text, at + half / 2, HEIGHT / 2 + 3);
      }
    });
  }
}
