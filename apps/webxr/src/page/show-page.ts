/** Shows the state on the page and in the headset from now on, and lets the view follow the robot. */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal, signal, untracked } from '@preact/signals-core';
import { type HeadsetSettings, otherHand } from '../ground/headset-settings.ts';
import type { Settings } from '../ground/settings.ts';
import type { Switches } from '../ground/switches.ts';
import { feelDone, giveCues } from '../panels/cues/cues.ts';
import type { OperatorInputs } from '../panels/ui/operator-inputs.ts';
import type { RememberedWorld } from '../panels/ui/remembered-world.ts';
import { cameraActions } from '../scene/console/console-actions.ts';
import { NoticeSign } from '../scene/headset/notice-sign.ts';
import { showNoticesInVr } from '../scene/headset/show-notices.ts';
import type { SensorClouds } from '../scene/view/sensor-clouds.ts';
import { SensorFrusta } from '../scene/view/sensor-frusta.ts';
import { showHazards } from '../scene/view/show-hazards.ts';
import type { Stage } from '../scene/view/stage.ts';
import { showPicturesInVr } from '../scene/view/vr-pictures.ts';
import type { VrSession } from '../scene/view/vr-session.ts';
import { WristPanel } from '../scene/view/wrist-panel.ts';
import { showOnWrist } from '../scene/view/wrist-status.ts';
import { type CloudAppearance, UNNAMED } from '../state/cloud-appearance.ts';
import { tellNotices } from '../state/notices.ts';
import type { PageState } from '../state/page-state.ts';
import type { Action } from '../take/drive/key-map.ts';
import type { PageStatistics } from '../words/page-stats.ts';
import { HeadsetControls, type HeadsetParts } from './headset-controls.ts';
import type { PagePanels } from './page-panels.ts';
import type { PageViews } from './page-views.ts';

export interface AppearanceParts {
  readonly appearance: CloudAppearance;
  readonly sensors: Switches;
  /** What the robot says about each sensor's rings, by the sensor's number. */
  readonly rings: ReadonlySignal<ReadonlyMap<number, readonly number[]>>;
  readonly clouds: SensorClouds;
  readonly stage: Pick<Stage, 'look' | 'headingUp' | 'world'>;
  readonly inVr: ReadonlySignal<boolean>;
  /** Whether the headset shows the world as a model, seen from above. */
  readonly inTabletop: ReadonlySignal<boolean>;
  readonly client: Pick<RobotClient, 'drawSurface' | 'on' | 'link'>;
  readonly remembered: Pick<RememberedWorld, 'on' | 'headingUp'>;
}

/** Applies what people have chosen about clouds to what draws them. */
function applyAppearance(parts: AppearanceParts): void {
  const { appearance, sensors, rings, clouds, stage, inVr, inTabletop, client, remembered } = parts;
  effect(() => client.drawSurface(appearance.drawsSurface.value));
  effect(() => {
    remembered.on = appearance.remembers.value;
  });
  const { fromAbove, headingUp, cut, cutFromAbove } = appearance;
  effect(() => {
    for (const [i, { colouring }] of clouds.all.value.entries()) {
      const { mode, fixed } = appearance.lookOf(sensors.all.value[i]?.name ?? UNNAMED);
      colouring.mode = mode;
      colouring.fixedRange = fixed;
      colouring.knownRings = rings.value.get(i) ?? null;
    }
  });
  effect(() => {
    const isFromAbove = inVr.value ? inTabletop.value : fromAbove.value;
    const inUse = isFromAbove ? cutFromAbove.value : cut.value;
    for (const { colouring } of clouds.all.value) colouring.cut = inUse;
  });
  showHazards({ client, clouds, appearance });
  const frusta = new SensorFrusta();
  stage.world.add(frusta.object);
  effect(() => {
    const shown = clouds.all.value.filter((_, i) => sensors.all.value[i]?.on.value ?? true);
    frusta.show(appearance.frusta.value ? shown : []);
  });
  effect(() => {
    stage.look.fromAbove = fromAbove.value;
    stage.headingUp = headingUp.value;
    remembered.headingUp = headingUp.value;
  });
}

/** Where the time goes, in the headset's menu: of the last so many ms, as in the line on the page (stages-line.ts). */
const STAGES_OVER_MS = 2000;

export interface HeadsetOptions
  extends Omit<
    HeadsetParts,
    'sources' | 'menuOpen' | 'panel' | 'pictures' | 'sign' | 'state' | 'stage' | 'actions'
  > {
  settings: HeadsetSettings;
  state: PageState;
  client: RobotClient;
  choose(robotId: string): void;
  /** Does what a key of the page does. */
  act(action: Action): void;
  appearance: Pick<CloudAppearance, 'hazards'>;
  stage: Stage;
  /** How far the hold is that releases the emergency stop, 0…1. */
  releaseProgress: ReadonlySignal<number>;
  /** Whether the operator holds a grip. */
  isGripped(): boolean;
}

/** What the headset has of the page. */
export interface OpenedHeadset {
  readonly panel: WristPanel;
  readonly sign: NoticeSign;
  readonly controls: HeadsetControls;
}

/** What a headset shows and reads: the sign before the eyes, the panel on the wrist, pictures, and the controllers. */
function openHeadset(options: HeadsetOptions): OpenedHeadset {
  const { settings, state, appearance, stage, vr, releaseProgress, isGripped } = options;
  const { renderer, rig, headset } = stage;
  const panel = new WristPanel(renderer, rig, headset.front, otherHand(settings.driveHand));
  effect(() => {
    panel.hand = otherHand(settings.driveHand);
  });
  const { active } = vr;
  showOnWrist({ state, appearance, panel, headset, settings, active, releaseProgress });
  const sign = new NoticeSign();
  const menuOpen = signal(false);
  showNoticesInVr({ state, sign, headset, settings, menuOpen, active, isGripped });
  const pictures = showPicturesInVr({ state, panel, stage, active });
  const { statistics } = options.client;
  const sources: HeadsetParts['sources'] = {
    state,
    headset,
    settings,
    passthrough: vr.passthrough,
    stages: (nowMs) => ({
      clouds: statistics.frameStages()?.window.summary(nowMs, STAGES_OVER_MS) ?? null,
      commands: statistics.commands.window.summary(nowMs, STAGES_OVER_MS),
    }),
  };
  const actions = headsetActions(options);
  return {
    panel,
    sign,
    controls: new HeadsetControls({ ...options, pictures, panel, sign, sources, actions, menuOpen }),
  };
}

/** What the headset's menu does, as the page's buttons do it. */
function headsetActions({ client, state, vr, choose, act }: HeadsetOptions): HeadsetParts['actions'] {
  const { people, driver } = client;
  return {
    stop: () => act('estop'),
    testLatency: () => act('latency-test'),
    recentre: () => act('recentre'),
    leave: () => void vr.leave(),
    choose,
    disconnect: () => client.leave(),
    takeOver: () => client.takeOver(),
    giveUp: () => driver.releaseLease(),
    askToDrive: () => people.askToDrive(),
    offerDrive: (operator) => people.offerDrive(operator),
    withdraw: (id) => people.withdraw(id),
    answer: (id, accept) => people.answer(id, accept),
    pressCommand: (id) => state.commands.press(id),
    cancelCommand: (id) => state.commands.cancel(id),
    ...cameraActions(state),
  };
}

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
  choose(robotId: string): void;
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
  tellNotices(client, state.notices, state.takeover);
  giveCues({ client, vr, settings, state, now: () => performance.now() });
}

export function showPage(parts: ShownParts): OpenedHeadset {
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
    client,
    choose: (robotId) => parts.choose(robotId),
    act: (action) => panels.controls.act(action, performance.now()),
    isGripped: () => client.driver.isGripped,
    gripLost: () => client.driver.lost,
    floor: panels.pointing,
    feel: (hand) => feelDone(settings, vr, hand),
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
