/** Shows the page's state in VR: the status on the wrist. */
import { computed, effect, type ReadonlySignal } from '@preact/signals-core';
import type { HeadsetSettings } from '../../ground/headset-settings.ts';
import type { CloudAppearance } from '../../state/cloud-appearance.ts';
import type { PageState } from '../../state/page-state.ts';
import { alarmLine } from '../../words/alarm-words.ts';
import { hazardHint } from '../../words/hazard-words.ts';
import { viewFact } from '../../words/headset-words.ts';
import { nearWords } from '../../words/near-words.ts';
import { emptyListWords } from '../../words/robots-words.ts';
import { stopWords } from '../../words/words.ts';
import { wristLines } from '../../words/wrist-lines.ts';
import type { HeadsetRig } from '../headset/headset-rig.ts';
import type { WristPanel } from './wrist-panel.ts';

export interface WristStatusParts {
  readonly state: PageState;
  readonly appearance: Pick<CloudAppearance, 'hazards'>;
  readonly panel: WristPanel;
  readonly headset: Pick<HeadsetRig, 'view' | 'model'>;
  readonly settings: Pick<HeadsetSettings, 'driveHand'>;
  /** Whether VR is active. */
  readonly active: ReadonlySignal<boolean>;
  /** Progress of the hold that releases the emergency stop, 0–1. */
  readonly releaseProgress: ReadonlySignal<number>;
}

export function showOnWrist({
  state,
  appearance,
  panel,
  headset,
  settings,
  active,
  releaseProgress,
}: WristStatusParts): void {
  const { link, driving, robot, figures } = state;
  const noRobots = computed(() => {
    const mayChoose = link.connected.value || link.nextRobot.value !== null;
    return mayChoose ? null : emptyListWords(link.signaling.value, link.host);
  });
  effect(() => {
    panel.visible = active.value;
  });
  effect(() => {
    if (!active.value) return;
    panel.show(
      wristLines({
        live: link.live.value,
        heard: link.heard.value,
        pointsHeard: robot.pointsHeard.value,
        link: link.line.value,
        driving: driving.line.value,
        telemetry: robot.telemetry.value,
        estopLatched: robot.estop.value.latched,
        nextRobot: link.nextRobot.value,
        noRobots: noRobots.value,
        speed: robot.speed.value,
        near: robot.tellsNear.value ? nearWords(robot.near.value) : null,
        estopAtRobot: robot.estopAtRobot.value,
        stop: stopWords(robot.stop.value),
        driveHand: settings.driveHand,
        view: viewFact(headset.view.value, headset.model.scale),
        hazards: hazardHint(appearance.hazards.value, robot.heights.value),
        alarm: alarmLine(robot.alarms.value),
        figures: figures.value,
      }),
    );
  });
  effect(() => {
    if (active.value) panel.showProgress(releaseProgress.value);
  });
}
