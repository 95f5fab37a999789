/** Shows the cameras' pictures in VR: beside the wrist panel, and the one that is enlarged or fills the view. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import type { PageState } from '../../state/page-state.ts';
import { FrontPicture } from './front-picture.ts';
import { PicturePointer } from './picture-pointer.ts';
import type { Stage } from './stage.ts';
import type { WristPanel } from './wrist-panel.ts';
import { WristPictures } from './wrist-pictures.ts';

export interface VrPicturesParts {
  readonly state: PageState;
  readonly panel: WristPanel;
  readonly stage: Pick<Stage, 'renderer' | 'rig' | 'headset'>;
  /** Whether VR is active. */
  readonly active: ReadonlySignal<boolean>;
}

/** @returns the pointer, which is to be updated before each display frame in VR */
export function showPicturesInVr({ state, panel, stage, active }: VrPicturesParts): PicturePointer {
  const { views, enlarged, staged } = state;
  const wrist = new WristPictures();
  const front = new FrontPicture();
  panel.addBeside(wrist.object);
  stage.headset.front.add(front.object);
  effect(() => {
    front.object.visible = active.value;
  });
  effect(() => {
    const inFront = staged.view.value ?? enlarged.view.value;
    wrist.setViews(views.value.filter((view) => view.camera.on.value && view !== inFront));
    front.set(inFront, inFront !== null && inFront === staged.view.value);
  });
  effect(() => {
    if (!active.value) return;
    wrist.caption(state.sampledAtMs);
    front.caption(state.sampledAtMs);
  });
  effect(() => {
    if (active.value) wrist.update();
  });
  effect(() => {
    if (active.value) front.update();
  });
  const sheets = () => [...front.sheets, ...wrist.sheets];
  return new PicturePointer(
    stage.renderer,
    stage.rig,
    () => sheets().map(({ mesh }) => mesh),
    (object) => {
      const view = sheets().find(({ mesh }) => mesh === object)?.view;
      // The trigger releases the emergency stop while that is on.
      if (view !== undefined && !state.robot.estopLatched.peek()) state.nextSize(view);
    },
  );
}
