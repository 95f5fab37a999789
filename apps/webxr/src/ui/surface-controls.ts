/** Whether clouds on a camera's grid are drawn as a surface or as points. */
import { effect } from '@preact/signals-core';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import { quietButton, rowOf } from './panel-parts.ts';

/** @param byDefault how they are drawn until somebody chooses */
export function surfaceControls({ surface }: CloudAppearance, byDefault: boolean): HTMLElement {
  const button = quietButton('Surfaces', 'Draw clouds of depth cameras as surfaces, or as points', () => {
    surface.value = !(surface.peek() ?? byDefault);
  });
  effect(() => {
    button.ariaPressed = String(surface.value ?? byDefault);
  });
  return rowOf('Draw', button);
}
