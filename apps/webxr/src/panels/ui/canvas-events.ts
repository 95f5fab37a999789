/** The canvas follows its place on the page, and says when the GPU's context is lost. */

import type { Stage } from '../../scene/view/stage.ts';
import type { Notices } from '../../state/notices.ts';
import { texts } from '../../words/language.ts';

export function listenToCanvas(
  canvas: HTMLCanvasElement,
  stage: Pick<Stage, 'resize'>,
  { failure }: Pick<Notices, 'failure'>,
): void {
  new ResizeObserver(() => stage.resize()).observe(canvas);
  canvas.addEventListener('webglcontextlost', () => {
    failure.value = texts().failures.contextLost;
  });
  canvas.addEventListener('webglcontextrestored', () => {
    failure.value = null;
  });
}
