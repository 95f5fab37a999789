/** Shows the cameras' pictures in VR: beside the wrist panel, and the one that is enlarged or fills the view. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import type { Object3D } from 'three';
import type { PageState } from '../state/page-state.ts';
import { FrontPicture } from './front-picture.ts';
import type { Stage } from './stage.ts';
import type { WristPanel } from './wrist-panel.ts';
import { WristPictures } from './wrist-pictures.ts';

export interface VrPicturesParts {
  readonly state: PageState;
  readonly panel: WristPanel;
  readonly stage: Pick<Stage, 'headset'>;
  /** Whether VR is active. */
  readonly active: ReadonlySignal<boolean>;
}

/** What a trigger can be pulled at. */
export interface PicturesInVr {
  targets(): readonly Object3D[];
  /** Shows this picture larger, if it is one. */
  choose(object: Object3D): void;
}

export function showPicturesInVr({ state, panel, stage, active }: VrPicturesParts): PicturesInVr {
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
  return {
    targets: () => sheets().map(({ mesh }) => mesh),
    choose(object) {
      const view = sheets().find(({ mesh }) => mesh === object)?.view;
      // The trigger releases the emergency stop while that is on.
      if (view !== undefined && !state.robot.estopLatched.peek()) state.nextSize(view);
    },
  };
}
