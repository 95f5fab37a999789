/** What a headset shows and reads: the panel on the wrist, pictures, the controllers, and the console. */
import type { RobotClient } from '@farpoint/operator';
import type { ReadonlySignal } from '@preact/signals-core';
import { vibrate } from '../cues/cue-haptics.ts';
import type { GoalsUi } from '../goals/goals-ui.ts';
import { HeadsetGoals } from '../goals/headset-goals.ts';
import type { Settings } from '../settings.ts';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import type { PageState } from '../state/page-state.ts';
import type { Action } from '../ui/operator-inputs.ts';
import type { Stage } from '../view/stage.ts';
import { showPicturesInVr } from '../view/vr-pictures.ts';
import { WristPanel } from '../view/wrist-panel.ts';
import { showOnWrist } from '../view/wrist-status.ts';
import { HeadsetControls, type HeadsetParts } from './headset-controls.ts';

export interface HeadsetOptions
  extends Omit<HeadsetParts, 'pictures' | 'settings' | 'state' | 'stage' | 'panel' | 'actions' | 'pulse'> {
  /** As they are at each use. */
  settings: Pick<Settings, 'headset' | 'cues'>;
  client: RobotClient;
  state: PageState;
  appearance: Pick<CloudAppearance, 'hazards'>;
  stage: Stage;
  goals: GoalsUi;
  /** How far the hold is that releases the emergency stop, 0…1. */
  releaseProgress: ReadonlySignal<number>;
  choose(robotId: string): void;
  /** Does what a key of the page does. */
  act(action: Action): void;
}

export function openHeadset(options: HeadsetOptions): HeadsetControls {
  const { settings: page, state, appearance, stage, vr, releaseProgress, client, choose, act } = options;
  const { renderer, rig, headset } = stage;
  const { headset: settings } = page;
  const { driveHand } = settings;
  const panel = new WristPanel(renderer, rig, headset.front, driveHand === 'right' ? 'left' : 'right');
  const pictures = showPicturesInVr({ state, panel, stage, active: vr.active });
  const controls = new HeadsetControls({
    ...{ settings, stage, vr, inputs: options.inputs, state, panel, pictures },
    actions: {
      stop: () => act('estop'),
      testLatency: () => act('latency-test'),
      recentre: () => act('recentre'),
      leave: () => vr.leave(),
      ...{ choose, disconnect: () => client.leave(), takeOver: () => client.takeOver() },
      handBack: () => client.driver.releaseLease(),
      askToDrive: () => client.people.askToDrive(),
      offerDrive: (operator) => client.people.offerDrive(operator),
      withdraw: (id) => client.people.withdraw(id),
      answer: (id, accept) => client.people.answer(id, accept),
    },
    pulse: () => {
      if (page.cues) vibrate('refused', vr.gamepads());
    },
  });
  // The model on the table is held by triggers.
  const isFree = (index: number) => headset.view.peek() !== 'tabletop' && controls.isTriggerFree(index);
  options.goals.headset = new HeadsetGoals({ goals: options.goals, stage, vr, isFree });
  const { readings } = controls.console;
  showOnWrist({ state, appearance, panel, headset, driveHand, active: vr.active, releaseProgress, readings });
  return controls;
}
