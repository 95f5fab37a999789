/** Whether clouds on a camera's grid are drawn as a surface or as points. */
import { effect } from '@preact/signals-core';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import { quietButton, rowOf } from './panel-parts.ts';

export function surfaceControls({ surface, drawsSurface }: CloudAppearance): HTMLElement {
  const button = quietButton('Surfaces', 'Draw clouds of depth cameras as surfaces, or as points', () => {
    surface.value = !drawsSurface.peek();
  });
  effect(() => {
    button.ariaPressed = String(drawsSurface.value);
  });
  return rowOf('Draw', button);
}
