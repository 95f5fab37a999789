/** Shows the state on the page and in the headset from now on, and lets the view follow the robot. */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal, untracked } from '@preact/signals-core';
import type { Settings } from '../ground/settings.ts';
import { giveCues } from '../panels/cues/cues.ts';
import type { OperatorInputs } from '../panels/ui/operator-inputs.ts';
import type { Stage } from '../scene/view/stage.ts';
import type { VrSession } from '../scene/view/vr-session.ts';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import type { PageState } from '../state/page-state.ts';
import { tellNotices } from '../state/tell-notices.ts';
import type { PageStatistics } from '../words/page-stats.ts';
import { applyAppearance } from './apply-appearance.ts';
import { openHeadset } from './open-headset.ts';
import type { PagePanels } from './page-panels.ts';
import type { PageViews } from './page-views.ts';

export interface ShownParts {
  readonly client: RobotClient;
  readonly settings: Settings;
  readonly state: PageState;
  readonly stage: Stage;
  readonly appearance: CloudAppearance;
  readonly views: PageViews;
  readonly stats: PageStatistics;
  readonly vr: VrSession;
  readonly inputs: OperatorInputs;
  readonly panels: PagePanels;
  /** How far the hold is that releases the emergency stop, 0…1. */
  readonly releaseProgress: ReadonlySignal<number>;
}

/** Call it before the client starts. */
export function followRobot({ client, settings, state, stage, views, stats, vr }: ShownParts): void {
  client.on('phase', (phase) => {
    if (phase === 'none') stage.forgetPose();
  });
  client.on('session', () => {
    stats.reset();
    stage.forgetPose();
  });
  client.on('telemetry', ({ pose }) => {
    stage.setBody(pose);
    views.clouds.ground = pose.position.z;
  });
  tellNotices(client, state.notices);
  if (settings.cues) giveCues(client, vr, () => performance.now());
}

/** @returns the headset's panel and controls */
export function showPage(parts: ShownParts): ReturnType<typeof openHeadset> {
  const { client, settings, state, stage, appearance, views, vr, inputs, panels, releaseProgress } = parts;
  const { clouds, remembered, cloud } = views;
  state.sample();
  panels.show();
  applyAppearance({
    appearance,
    sensors: state.sensors,
    rings: state.rings,
    clouds,
    stage,
    inVr: vr.active,
    inTabletop: computed(() => stage.headset.view.value === 'tabletop'),
    client,
    remembered,
  });
  const headset = openHeadset({
    settings: settings.headset,
    stage,
    vr,
    inputs,
    state,
    appearance,
    releaseProgress,
  });
  effect(() => {
    cloud.sizeScale = state.pointScale.value;
  });
  effect(() => {
    const active = vr.active.value;
    untracked(() => inputs.releaseAll());
    if (!active) stage.resize();
  });
  return headset;
}
