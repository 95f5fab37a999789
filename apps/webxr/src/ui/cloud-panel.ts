/**
 * The panel for clouds: what their colours mean, as colour bars to read values off, and the controls for it. It has
 * no field to type in and no control keeps the focus after a click, because both would take keys from driving.
 */
import { type CloudView, colourStops } from '@farpoint/cloud-view';
import { effect, type ReadonlySignal, signal, untracked } from '@preact/signals-core';
import { type CloudAppearance, UNNAMED } from '../state/cloud-appearance.ts';
import type { Switches } from '../state/switches.ts';
import { colourControls } from './colour-controls.ts';
import { QUANTITIES, ticksOf } from './colour-ticks.ts';
import { cutControls } from './cut-controls.ts';
import { elements } from './elements.ts';
import { quietButton } from './panel-parts.ts';

export interface CloudPanelParts {
  readonly appearance: CloudAppearance;
  /** Empty for a robot with one sensor. */
  readonly sensors: Switches;
  readonly views: ReadonlySignal<readonly CloudView[]>;
}

/** A colour bar, and how its numbers are brought up to date. */
interface Legend {
  readonly element: HTMLElement;
  update(): void;
}

export class CloudPanel {
  readonly #parts: CloudPanelParts;
  #legends: readonly Legend[] = [];

  constructor(parts: CloudPanelParts) {
    this.#parts = parts;
    const { appearance } = parts;
    const open = signal(false);
    const fromAbove = quietButton('From above', 'The surroundings from above (T)', () => {
      appearance.fromAbove.value = !appearance.fromAbove.peek();
    });
    fromAbove.id = 'from-above';
    const colours = quietButton('Colours', 'Colours of the clouds, heights that are drawn', () => {
      open.value = !open.peek();
    });
    colours.id = 'colours-open';
    const legends = element('div', 'legends');
    const controls = element('div', 'controls');
    const heads = element('div', 'heads');
    heads.append(fromAbove, colours);
    elements.clouds.append(heads, legends, controls);
    effect(() => {
      fromAbove.ariaPressed = String(appearance.fromAbove.value);
    });
    effect(() => {
      colours.ariaExpanded = String(open.value);
      controls.hidden = !open.value;
    });
    effect(() => {
      this.#legends = this.#sensors().flatMap(({ name, on, view }) => (on ? this.#legendOf(name, view) : []));
      legends.replaceChildren(...this.#legends.map((legend) => legend.element));
    });
    const ofSensors = element('div', '');
    controls.append(ofSensors, cutControls(appearance));
    effect(() => {
      const parts = this.#names().map((name, i) =>
        untracked(() =>
          colourControls(name, appearance, () => this.#parts.views.peek()[i]?.colouring.range ?? null),
        ),
      );
      ofSensors.replaceChildren(...parts.map((part) => part.element));
      return () => {
        for (const { dispose } of parts) dispose();
      };
    });
  }

  /** Brings the numbers up to date. Call it a few times a second. */
  update(): void {
    for (const legend of this.#legends) legend.update();
  }

  #names(): string[] {
    const all = this.#parts.sensors.all.value;
    return all.length === 0 ? [UNNAMED] : all.map(({ name }) => name);
  }

  #sensors(): { name: string; on: boolean; view: CloudView | undefined }[] {
    const { sensors, views } = this.#parts;
    return this.#names().map((name, i) => ({
      ...{ name, view: views.value[i] },
      on: sensors.all.value[i]?.on.value ?? true,
    }));
  }

  #legendOf(name: string, view: CloudView | undefined): Legend[] {
    const { mode } = this.#parts.appearance.lookOf(name);
    if (mode === 'captured' || view === undefined) return [];
    const { name: quantity, unit, scale } = QUANTITIES[mode];
    const figure = element('figure', 'legend');
    const caption = element('figcaption', '');
    caption.textContent = `${name === UNNAMED ? '' : `${name}: `}${quantity}, ${unit}`;
    const bar = element('div', 'colour-bar');
    bar.style.background = mode === 'age' ? FADE : GRADIENT;
    const numbers = element('div', 'numbers');
    figure.append(caption, bar, numbers);
    let shown = '';
    const update = () => {
      const { min, max } = view.colouring.range;
      const ticks = ticksOf(min * scale, max * scale);
      const now = ticks.map(({ place, text }) => `${(place * 100).toFixed(0)} ${text}`).join();
      if (now === shown) return;
      shown = now;
      numbers.replaceChildren(
        ...ticks.map(({ place, text }) => {
          const number = element('span', '');
          number.textContent = text;
          number.style.left = `${(place * 100).toFixed(1)}%`;
          return number;
        }),
      );
    };
    update();
    return [{ element: figure, update }];
  }
}

const GRADIENT = `linear-gradient(90deg, ${colourStops()
  .map((rgb) => `rgb(${rgb.map((part) => Math.round(part * 255)).join()})`)
  .join()})`;
/** Old points are dim. */
const FADE = 'linear-gradient(90deg, #fff, #404040)';

function element(kind: 'div' | 'figure' | 'figcaption' | 'span', className: string): HTMLElement {
  const made = document.createElement(kind);
  made.className = className;
  return made;
}
