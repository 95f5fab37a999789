/** The page: shows on the screen what the robot sends, and sends the robot what the operator's hands do. */
import type { RobotClient, RobotClientOptions, TransformSupport } from '@farpoint/operator';
import { computed, effect, untracked } from '@preact/signals-core';
import { PanelPlacements } from '../ground/panels/panel-placements.ts';
import { loadPlacements, storePlacements } from '../ground/panels/stored-panels.ts';
import type { Settings } from '../ground/settings.ts';
import { TelemetryRecorder } from '../ground/telemetry/recorder.ts';
import { giveCues } from '../panels/cues/cues.ts';
import { elements } from '../panels/ui/elements.ts';
import { OperatorInputs } from '../panels/ui/operator-inputs.ts';
import { NearFieldDisplay } from '../panels/ui/show-near-field.ts';
import { PredictedView } from '../scene/view/predicted-view.ts';
import { showDrivePath, showNavigation, showRobotModel } from '../scene/view/show-robot.ts';
import { Stage } from '../scene/view/stage.ts';
import { VrSession } from '../scene/view/vr-session.ts';
import type { WristPanel } from '../scene/view/wrist-panel.ts';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import type { Notices } from '../state/notices.ts';
import { PageState } from '../state/page-state.ts';
import { openAppearance } from '../state/stored-appearance.ts';
import { tellNotices } from '../state/tell-notices.ts';
import { AwayRelease } from '../take/drive/away-release.ts';
import { ReleaseHold } from '../take/drive/release-hold.ts';
import { SoundPlayer } from '../take/sound/sound-player.ts';
import { viewAgeMs } from '../words/motion-words.ts';
import { PageStatistics, type PageStats } from '../words/page-stats.ts';
import { leavingWords } from '../words/words.ts';
import { applyAppearance } from './apply-appearance.ts';
import { FrameLoop } from './frame-loop.ts';
import type { HeadsetControls } from './headset-controls.ts';
import { openClient } from './open-client.ts';
import { openHeadset } from './open-headset.ts';
import { PagePanels } from './page-panels.ts';
import { PageViews } from './page-views.ts';

const [DRIVE_TICK_MS, STATUS_TICK_MS] = [25, 250];

export class App {
  readonly settings: Settings;
  readonly state: PageState;
  readonly stage: Stage;
  readonly client: RobotClient;
  /** Clouds, videos, and what was seen before. */
  readonly views: PageViews;
  readonly appearance: CloudAppearance;
  readonly stats = new PageStatistics();
  readonly vr: VrSession;
  readonly frames: FrameLoop;
  readonly near: NearFieldDisplay;
  /** Plays the robot's microphone. */
  readonly player = new SoundPlayer();
  readonly #inputs: OperatorInputs;
  readonly #panels: PagePanels;
  /** The panel on the wrist in VR. */
  wrist: WristPanel | null = null;
  #headset: HeadsetControls | null = null;
  readonly #release = new ReleaseHold();
  readonly #left = new AwayRelease();

  /** @param openLink of tests @throws {Error} without WebGL 2 */
  constructor(
    settings: Settings,
    transform: TransformSupport,
    notices: Notices,
    openLink?: RobotClientOptions['openLink'],
  ) {
    this.settings = settings;
    const stage = new Stage(elements.stage, settings.canvas, settings.headset);
    this.stage = stage;
    const appearance = openAppearance(settings, stage.renderer.getContext());
    this.appearance = appearance;
    this.#inputs = this.#openInputs(notices);
    const { client, receiver, ...opened } = openClient({
      settings,
      transform,
      inputs: this.#inputs,
      openLink,
    });
    this.client = client;
    const predicted = new PredictedView(client, settings.predict);
    stage.predicted = predicted;
    this.state = new PageState({
      client,
      settings,
      notices,
      figures: () => this.figures(),
      placements: new PanelPlacements(loadPlacements(), storePlacements),
      now: () => performance.now(),
      newCanvas: () => document.createElement('canvas'),
    });
    const { state, stats, player } = this;
    const views = new PageViews({ client, settings, stage, state, appearance, predicted, receiver });
    this.views = views;
    const vr = new VrSession(stage.renderer, settings.headset);
    this.vr = vr;
    this.near = new NearFieldDisplay(client, stage, vr.active);
    this.#panels = new PagePanels({
      ...opened,
      client,
      settings,
      state,
      stage,
      appearance,
      views,
      recorder: new TelemetryRecorder(client, () => performance.now()),
      vr,
      player,
      release: this.#release,
      choose: (robotId) => this.choose(robotId),
      nextHeadsetView: () => this.#headset?.nextView(),
    });
    const readHeadset = () => this.#headset?.read();
    const { held, cloud, clouds, videos, remembered } = views;
    this.frames = new FrameLoop({
      settings,
      client,
      stage,
      held,
      cloud,
      clouds,
      videos,
      stats,
      vr,
      readHeadset,
      remembered,
    });
  }

  #openInputs(notices: Notices): OperatorInputs {
    return new OperatorInputs(
      {
        onChange: () => this.client.driver.tick(performance.now()),
        onAction: (action, timeMs) => this.#panels.controls.act(action, timeMs),
        onRelease: (control, held) => this.#panels.estop.hold(control, held),
        onTalk: (control, held) => this.#panels.sound.hold(control, held),
        mayDrive: () => this.state.link.live.value,
      },
      this.settings.headset.driveHand,
      notices,
    );
  }

  start(): void {
    this.#listen();
    this.#panels.start();
    this.client.start();
    if (this.settings.robot !== null) this.client.choose(this.settings.robot);
    this.#show();
    setInterval(() => {
      const nowMs = performance.now();
      this.frames.measureGap(nowMs);
      this.#inputs.poll(nowMs);
      const away = this.#handsAway();
      this.#panels.estop.update(nowMs, away);
      const { driver } = this.client;
      driver.suspended = away || this.state.driving.role.value === 'watch';
      if (this.#left.decide(this.vr.active.value ? this.vr.hidden : document.hidden, nowMs))
        driver.letGo(nowMs);
      this.client.tick(performance.now());
      showRobotModel(this.client, this.stage, this.appearance);
      showDrivePath(this.client, this.stage);
      showNavigation(this.client, this.stage, this.appearance, nowMs);
      this.near.update(nowMs);
    }, DRIVE_TICK_MS);
    setInterval(() => {
      const nowMs = performance.now();
      this.stats.update(this.views.cloud, nowMs);
      this.stats.remembered = this.views.remembered.updateMap(nowMs);
      this.views.videoColour.update(nowMs);
      this.views.videos.measure(nowMs);
      this.state.looking.value = this.vr.active.value || !document.hidden;
      this.state.sample();
      this.#panels.cloudPanel.update();
      this.frames.govern(nowMs);
    }, STATUS_TICK_MS);
    this.frames.start();
  }

  /** Connects to this robot. A robot that was chosen before is stopped first. */
  choose(robotId: string): void {
    this.client.choose(robotId);
    if (this.client.chosenRobotId !== this.client.link.robotId) this.state.notices.tell(leavingWords);
    this.state.sample();
  }

  /** Current figures of the stream and of the drawing. */
  figures(): PageStats {
    const nowMs = performance.now();
    const { cloud, videos, predicted, videoColour } = this.views;
    const shown = { canvas: this.stage.renderer.domElement, videos: videos.stats(nowMs) };
    const ageMs = viewAgeMs(this.client, nowMs);
    const stats = this.stats.snapshot(this.client.stats(), cloud, { ...shown, viewAgeMs: ageMs });
    return { ...stats, view: predicted.figures, videoColour: videoColour.figures };
  }

  #show(): void {
    const { state, stage, vr, client, appearance } = this;
    const { clouds, remembered, cloud } = this.views;
    state.sample();
    this.#panels.show();
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
    const { panel, controls } = openHeadset({
      settings: this.settings.headset,
      stage,
      vr,
      inputs: this.#inputs,
      state,
      appearance,
      releaseProgress: this.#release.progress,
    });
    this.wrist = panel;
    this.#headset = controls;
    effect(() => {
      cloud.sizeScale = state.pointScale.value;
    });
    effect(() => {
      const active = vr.active.value;
      untracked(() => this.#inputs.releaseAll());
      if (!active) stage.resize();
    });
  }

  /** Commands may come only from an operator who can see their effect. */
  #handsAway(): boolean {
    if (this.vr.active.value) return this.vr.hidden;
    return document.hidden || !document.hasFocus();
  }

  #listen(): void {
    const { client, stage } = this;
    client.on('phase', (phase) => {
      if (phase === 'none') stage.forgetPose();
    });
    client.on('session', () => {
      this.stats.reset();
      stage.forgetPose();
    });
    client.on('telemetry', ({ pose }) => {
      stage.setBody(pose);
      this.views.clouds.ground = pose.position.z;
    });
    tellNotices(client, this.state.notices);
    if (this.settings.cues) giveCues(client, this.vr, () => performance.now());
  }
}
