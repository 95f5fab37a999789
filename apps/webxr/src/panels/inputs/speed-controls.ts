/** The controls for the greatest speed: a slider, and a button for the next gear that says what is chosen. */
import type { Role } from '@farpoint/protocol';
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { SPEED_SHARES, type SpeedChoice } from '../../take/drive/speed-choice.ts';
import { speedShareWords } from '../../words/input-words.ts';
import { texts } from '../../words/language.ts';
import { elements } from '../ui/elements.ts';
import { quietButton, sliderOf } from '../ui/panel-parts.ts';

/** The slider's step. Chosen: ten steps between two gears are more than a hand tells apart; inputs.page.ts moves it. */
const STEP = 0.05;

export interface SpeedControls {
  readonly elements: readonly [slider: HTMLInputElement, gear: HTMLButtonElement];
  dispose(): void;
}

/** @param maxLinear the most that the robot ever drives, m/s; 0 while it is not known */
export function speedControls(speed: SpeedChoice, maxLinear: ReadonlySignal<number>): SpeedControls {
  const scale = { min: SPEED_SHARES.least, max: SPEED_SHARES.most, step: STEP };
  const slider = sliderOf('', scale, (share) => speed.set(share));
  const gear = quietButton('', '', () => speed.cycle());
  gear.classList.add('gear');
  const dispose = effect(() => {
    const { speedTitle, gear: gearWords } = texts().inputs;
    const share = speed.share.value;
    const words = speedShareWords(share, maxLinear.value);
    slider.ariaLabel = speedTitle;
    slider.title = speedTitle;
    slider.value = String(share);
    slider.setAttribute('aria-valuetext', words);
    gear.textContent = words;
    gear.ariaLabel = `${gearWords}: ${words}`;
    gear.title = gearWords;
    gear.dataset.reduced = String(share < SPEED_SHARES.most);
  });
  return { elements: [slider, gear], dispose };
}

/** Puts the controls beside those for driving, as long as this operator may drive. */
export function showSpeedChoice(
  speed: SpeedChoice,
  maxLinear: ReadonlySignal<number>,
  role: ReadonlySignal<Role | null>,
): void {
  const place = document.createElement('span');
  place.id = 'speed-choice';
  place.append(...speedControls(speed, maxLinear).elements);
  elements.latency.before(place);
  effect(() => {
    place.hidden = role.value === 'watch';
  });
}
