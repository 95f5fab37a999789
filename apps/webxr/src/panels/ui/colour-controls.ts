/** For one sensor: what its colours mean, and their range. */
import { COLOUR_MODES, type ColourMode, type ValueRange } from '@farpoint/cloud-view';
import { effect } from '@preact/signals-core';
import { type CloudAppearance, UNNAMED } from '../../state/cloud-appearance.ts';
import { texts } from '../../words/language.ts';
import { isValued, type ValuedMode } from './colour-ticks.ts';
import { quietButton, rowOf, type SliderScale, selectOf, sliderOf } from './panel-parts.ts';

/** Limits of a fixed range, in the mode's unit. */
const SCALES: Readonly<Record<ValuedMode, SliderScale>> = {
  height: { min: -2, max: 8, step: 0.1 },
  distance: { min: 0, max: 60, step: 0.5 },
  intensity: { min: 0, max: 1, step: 0.02 },
  age: { min: 0, max: 2, step: 0.02 },
};

/**
 * @param name of the sensor
 * @param current the range in use: a range that is fixed begins with it
 */
export function colourControls(
  name: string,
  appearance: CloudAppearance,
  current: () => Readonly<ValueRange> | null,
): { element: HTMLElement; dispose: () => void } {
  const said = texts().clouds;
  const shownName = name === UNNAMED ? said.cloud : name;
  const group = document.createElement('div');
  const mode = selectOf(
    { label: said.modeOf(shownName), values: COLOUR_MODES, texts: said.modes },
    (chosen) => {
      appearance.setLook(name, { mode: chosen, fixed: null });
    },
  );
  const range = document.createElement('div');
  group.append(rowOf(shownName, mode), range);
  let shown: ColourMode | null = null;
  let update: (fixed: Readonly<ValueRange> | null) => void = () => {};
  const dispose = effect(() => {
    const look = appearance.lookOf(name);
    mode.value = look.mode;
    const { mode: chosen } = look;
    range.hidden = !isValued(chosen);
    if (isValued(chosen) && chosen !== shown) {
      const parts = rangeControls(chosen, shownName, current, (fixed) =>
        appearance.setLook(name, { mode: appearance.lookOf(name).mode, fixed }),
      );
      range.replaceChildren(...parts.rows);
      update = parts.update;
    }
    shown = chosen;
    update(look.fixed);
  });
  return { element: group, dispose };
}

function rangeControls(
  mode: ValuedMode,
  name: string,
  current: () => Readonly<ValueRange> | null,
  change: (fixed: ValueRange | null) => void,
) {
  const said = texts().clouds;
  const scale = SCALES[mode];
  const { step } = scale;
  const fit = (value: number) => Math.min(Math.max(Math.round(value / step) * step, scale.min), scale.max);
  let fixed: Readonly<ValueRange> | null = null;
  const auto = quietButton(said.auto, said.autoTitle(name), () => {
    if (fixed !== null) return change(null);
    const { min, max } = current() ?? scale;
    const from = Math.min(fit(min), scale.max - step);
    change({ min: from, max: Math.max(fit(max), from + step) });
  });
  const from = sliderOf(said.rangeFrom(name), scale, (min) => {
    change({ min: Math.min(min, scale.max - step), max: Math.max(fixed?.max ?? scale.max, min + step) });
  });
  const to = sliderOf(said.rangeTo(name), scale, (max) => {
    change({ min: Math.min(fixed?.min ?? scale.min, max - step), max: Math.max(max, scale.min + step) });
  });
  const ends = document.createElement('div');
  ends.className = 'ends';
  ends.append(from, to);
  return {
    rows: [rowOf(said.range, auto), ends],
    update(now: Readonly<ValueRange> | null): void {
      fixed = now;
      auto.ariaPressed = String(now === null);
      ends.hidden = now === null;
      if (now === null) return;
      from.value = String(now.min);
      to.value = String(now.max);
    },
  };
}
