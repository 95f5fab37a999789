/** The controls for the greatest speed: a slider, and a button for the next gear that says what is chosen. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { SPEED_SHARES, type SpeedChoice } from '../drive/speed-choice.ts';
import { speedShareWords } from '../status/input-words.ts';
import { quietButton, sliderOf } from './panel-parts.ts';

/** @param maxLinear the most that the robot ever drives, m/s; 0 while it is not known */
export function speedControls(
  speed: SpeedChoice,
  maxLinear: ReadonlySignal<number>,
): readonly [slider: HTMLInputElement, gear: HTMLButtonElement] {
  const { least: min, most: max } = SPEED_SHARES;
  const slider = sliderOf('Greatest speed', { min, max, step: 0.05 }, (share) => speed.set(share));
  const gear = quietButton('', 'Next gear (lower: , higher: .)', () => speed.cycle());
  gear.className = 'quiet gear';
  effect(() => {
    const share = speed.share.value;
    const words = speedShareWords(share, maxLinear.value);
    slider.value = String(share);
    slider.setAttribute('aria-valuetext', words);
    gear.textContent = words;
    gear.dataset.reduced = String(share < SPEED_SHARES.most);
  });
  return [slider, gear];
}
