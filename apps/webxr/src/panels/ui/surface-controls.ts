/** Whether clouds on a camera's grid are drawn as a surface or as points, and what paints the surface. */
import { effect } from '@preact/signals-core';
import type { CloudAppearance } from '../../state/cloud-appearance.ts';
import { quietButton, rowOf } from './panel-parts.ts';

export function surfaceControls({ surface, drawsSurface, paint }: CloudAppearance): HTMLElement {
  const button = quietButton('Surfaces', 'Draw clouds of depth cameras as surfaces, or as points', () => {
    surface.value = !drawsSurface.peek();
  });
  const video = quietButton(
    'Video',
    'Paint surfaces with the depth camera’s video where the robot sends it, or with the points’ own colours',
    () => {
      paint.value = !paint.peek();
    },
  );
  const group = document.createElement('div');
  const painting = rowOf('Paint', video);
  effect(() => {
    button.ariaPressed = String(drawsSurface.value);
    video.ariaPressed = String(paint.value);
    painting.hidden = !drawsSurface.value;
  });
  group.append(rowOf('Draw', button), painting);
  return group;
}
