/** Saves what the scene shows as a PNG file: as it was drawn, without the panels over it. */
import type { PageState } from '../state/page-state.ts';
import { sceneWords } from '../status/scene-words.ts';
import type { FrameLoop } from '../view/frame-loop.ts';
import { saveFile } from './save-file.ts';

export interface SceneParts {
  readonly canvas: HTMLCanvasElement;
  readonly frames: Pick<FrameLoop, 'afterNextFrame'>;
  readonly state: Pick<PageState, 'link' | 'notices'>;
  /** Whether the scene is in a headset, and the canvas shows nothing. */
  readonly inVr: boolean;
}

export function saveScene({ canvas, frames, state, inVr }: SceneParts): void {
  const { link, notices } = state;
  if (inVr) notices.tell(sceneWords.inVr);
  else if (!link.connected.peek()) notices.tell(sceneWords.noRobot);
  else {
    // Later the canvas is empty: the browser has taken the picture.
    frames.afterNextFrame(() =>
      canvas.toBlob((picture) => {
        if (picture === null) {
          notices.tell(sceneWords.failed, 'warning');
          return;
        }
        saveFile('scene', 'png', picture);
        notices.tell(link.live.peek() ? sceneWords.saved : sceneWords.savedOld);
      }, 'image/png'),
    );
  }
}
