/** What a headset shows and reads: the panel on the wrist, pictures, and the controllers. */
import type { ReadonlySignal } from '@preact/signals-core';
import type { Stage } from '../scene/view/stage.ts';
import { showPicturesInVr } from '../scene/view/vr-pictures.ts';
import { WristPanel } from '../scene/view/wrist-panel.ts';
import { showOnWrist } from '../scene/view/wrist-status.ts';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import type { PageState } from '../state/page-state.ts';
import { HeadsetControls, type HeadsetParts } from './headset-controls.ts';

export interface HeadsetOptions extends Omit<HeadsetParts, 'pointer' | 'state' | 'stage'> {
  state: PageState;
  appearance: Pick<CloudAppearance, 'hazards'>;
  stage: Stage;
  /** How far the hold is that releases the emergency stop, 0…1. */
  releaseProgress: ReadonlySignal<number>;
}

export function openHeadset(options: HeadsetOptions): { panel: WristPanel; controls: HeadsetControls } {
  const { settings, state, appearance, stage, vr, releaseProgress } = options;
  const { renderer, rig, headset } = stage;
  const { driveHand } = settings;
  const panel = new WristPanel(renderer, rig, headset.front, driveHand === 'right' ? 'left' : 'right');
  showOnWrist({ state, appearance, panel, headset, driveHand, active: vr.active, releaseProgress });
  const pointer = showPicturesInVr({ state, panel, stage, active: vr.active });
  return { panel, controls: new HeadsetControls({ ...options, pointer }) };
}
