/** What the colours of a cloud stand for: a bar of the colours, with numbers below it. */
import {
  type CloudView,
  type ColourMode,
  colourStops,
  LIT_AMBIENT,
  type Rgb,
  RING_COLOURS,
  type Rings,
  ringColours,
} from '@farpoint/cloud-view';
import { texts } from '../../words/language.ts';
import { QUANTITIES, type Tick, ticksOf, type ValuedMode } from './colour-ticks.ts';

export interface Legend {
  readonly element: HTMLElement;
  /** Brings the numbers up to date. Call it a few times a second. */
  update(): void;
}

/** @param title names the sensor, or is empty */
export function legendOf(title: string, mode: Exclude<ColourMode, 'captured'>, view: CloudView): Legend {
  if (mode === 'ring') return ringLegend(title, view);
  return mode === 'lit' ? litLegend(title, view) : valueLegend(title, mode, view);
}

function litLegend(title: string, view: Pick<CloudView, 'isSurface'>): Legend {
  const said = texts().clouds;
  const parts = legendParts();
  parts.bar.style.background = LIT;
  parts.show([
    { place: 0.08, text: said.facing },
    { place: 0.9, text: said.edgeOn },
  ]);
  let shown: boolean | null = null;
  const update = () => {
    const { isSurface } = view;
    if (isSurface === shown) return;
    shown = isSurface;
    parts.caption.textContent = `${title}${isSurface ? said.lit : said.notLit}`;
    parts.bar.hidden = parts.numbers.hidden = !isSurface;
  };
  update();
  return { element: parts.element, update };
}

function valueLegend(title: string, mode: ValuedMode, view: CloudView): Legend {
  const { unit, scale } = QUANTITIES[mode];
  const parts = legendParts();
  parts.caption.textContent = `${title}${texts().clouds.modes[mode]}, ${unit}`;
  parts.bar.style.background = mode === 'age' ? FADE : GRADIENT;
  const update = () => {
    const { min, max } = view.colouring.range;
    parts.show(ticksOf(min * scale, max * scale));
  };
  update();
  return { element: parts.element, update };
}

function ringLegend(title: string, view: CloudView): Legend {
  const parts = legendParts();
  let shown: unknown;
  const update = () => {
    const { rings } = view.colouring;
    if (rings === shown) return;
    shown = rings;
    parts.caption.textContent = `${title}${ringCaption(rings)}`;
    parts.caption.title = rings?.from === 'points' ? texts().clouds.ringsEstimatedTitle : '';
    const count = rings?.elevations.length ?? 0;
    parts.bar.hidden = parts.numbers.hidden = rings === null;
    parts.bar.style.background = ringBar(count, cssOf);
    parts.show(ringTicks(count));
  };
  update();
  return { element: parts.element, update };
}

function legendParts() {
  const figure = element('figure', 'legend overlay');
  const caption = element('figcaption', '');
  const bar = element('div', 'colour-bar');
  const numbers = element('div', 'numbers');
  figure.append(caption, bar, numbers);
  let shown = '';
  const show = (ticks: readonly Tick[]) => {
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
  return { element: figure, caption, bar, numbers, show };
}

export const cssOf = (rgb: Rgb) => `rgb(${rgb.map((part) => Math.round(part * 255)).join()})`;
const GRADIENT = `linear-gradient(90deg, ${colourStops().map(cssOf).join()})`;
/** Old points are dim. */
const FADE = 'linear-gradient(90deg, #fff, #404040)';
/** From a surface that faces the eye to one that is seen edge-on. */
const LIT = `linear-gradient(90deg, #fff, ${cssOf([LIT_AMBIENT, LIT_AMBIENT, LIT_AMBIENT])})`;

function element(kind: 'div' | 'figure' | 'figcaption' | 'span', className: string): HTMLElement {
  const made = document.createElement(kind);
  made.className = className;
  return made;
}

/** Names a LiDAR's rings: each has its colour, side by side from the lowest to the highest. @param rings `null`: none are known */
export function ringCaption(rings: Rings | null): string {
  const said = texts().clouds;
  if (rings === null) return said.noRings;
  const { length } = rings.elevations;
  return rings.from === 'points' ? said.ringsEstimated(length) : said.rings(length);
}

/** A CSS background. */
export function ringBar(count: number, cssOf: (colour: Rgb) => string): string {
  const end = (ring: number) => `${((ring / count) * 100).toFixed(2)}%`;
  const bands = Array.from({ length: count }, (_, ring) => {
    const colour = ringColours()[ring % RING_COLOURS] as Rgb;
    return `${cssOf(colour)} ${end(ring)} ${end(ring + 1)}`;
  });
  return count === 0 ? 'none' : `linear-gradient(90deg, ${bands.join()})`;
}

/** Between numbered rings; one of them is enough for 256 rings. */
const STEPS = [1, 2, 5, 10, 20, 50, 100];
const MOST_TICKS = 5;

/** Round numbers of rings, each below the middle of its ring. */
export function ringTicks(count: number): Tick[] {
  const step = STEPS.find((each) => count <= each * MOST_TICKS) ?? count;
  return Array.from({ length: Math.ceil(count / step) }, (_, i) => ({
    place: (i * step + 0.5) / count,
    text: String(i * step),
  }));
}
