/** The page: shows on the screen what the robot sends, and sends the robot what the operator's hands do. */
import { CloudView } from '@farpoint/cloud-view';
import { RobotClient, type RobotClientOptions, type TransformSupport } from '@farpoint/operator';
import { computed, effect, untracked } from '@preact/signals-core';
import { StoredRobots } from '../ground/access/known-robots.ts';
import { OperatorAccess } from '../ground/access/operator-access.ts';
import { SignIn, tabStorage } from '../ground/access/sign-in.ts';
import { browserAccess } from '../ground/access/stored-access.ts';
import { PanelPlacements } from '../ground/panels/panel-placements.ts';
import { loadPlacements, storePlacements } from '../ground/panels/stored-panels.ts';
import type { Settings } from '../ground/settings.ts';
import { tokenOrigin } from '../ground/signaling-tokens.ts';
import { PresentedInstant } from '../ground/telemetry/presented-instant.ts';
import { TelemetryRecorder } from '../ground/telemetry/recorder.ts';
import { giveCues } from '../panels/cues/cues.ts';
import { DashboardOpener } from '../panels/dashboard/dashboard-opener.ts';
import { AccessUi } from '../panels/ui/access-ui.ts';
import { listenToCanvas } from '../panels/ui/canvas-events.ts';
import { CloudPanel } from '../panels/ui/cloud-panel.ts';
import { ControlsUi } from '../panels/ui/controls-ui.ts';
import { elements } from '../panels/ui/elements.ts';
import { EstopUi } from '../panels/ui/estop-ui.ts';
import { showNearWords } from '../panels/ui/near-panel.ts';
import { type InputPort, OperatorInputs } from '../panels/ui/operator-inputs.ts';
import { showPeople } from '../panels/ui/people-panel.ts';
import { showPicturePanels } from '../panels/ui/picture-panels.ts';
import { RememberedWorld } from '../panels/ui/remembered-world.ts';
import { showRobotList } from '../panels/ui/robot-list.ts';
import { showRobotSwitcher } from '../panels/ui/robot-switcher.ts';
import { showSensorSwitches } from '../panels/ui/sensor-switches.ts';
import { NearFieldDisplay } from '../panels/ui/show-near-field.ts';
import { SoundUi } from '../panels/ui/sound-ui.ts';
import { showStatus } from '../panels/ui/status-ui.ts';
import { PredictedView } from '../scene/view/predicted-view.ts';
import { SensorClouds } from '../scene/view/sensor-clouds.ts';
import { showDrivePath } from '../scene/view/show-drive-path.ts';
import { showNavigation } from '../scene/view/show-navigation.ts';
import { showRobotModel } from '../scene/view/show-robot-model.ts';
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
import { CloudHold, driverHold, noHold } from '../take/video/cloud-hold.ts';
import { HeldClouds } from '../take/video/held-clouds.ts';
import { VideoColour } from '../take/video/video-colour.ts';
import { VideoFeed } from '../take/video/video-feed.ts';
import { videoReceiver } from '../take/video/video-receiver.ts';
import { PageStatistics, type PageStats } from '../words/page-stats.ts';
import { viewAgeMs } from '../words/view-age.ts';
import { leavingWords, videoWords } from '../words/words.ts';
import { applyAppearance } from './apply-appearance.ts';
import { FrameLoop } from './frame-loop.ts';
import type { HeadsetControls } from './headset-controls.ts';
import { openHeadset } from './open-headset.ts';

type OpenLink = RobotClientOptions['openLink'];
const [DRIVE_TICK_MS, STATUS_TICK_MS] = [25, 250];

export class App {
  readonly settings: Settings;
  readonly state: PageState;
  readonly stage: Stage;
  readonly cloud: CloudView;
  /** The clouds of a robot with several sensors. */
  readonly clouds: SensorClouds;
  /** What was seen before. */
  readonly remembered: RememberedWorld;
  readonly client: RobotClient;
  /** Reads and presents the robot's videos. */
  readonly videos: VideoFeed;
  readonly appearance: CloudAppearance;
  readonly stats = new PageStatistics();
  /** The capture instant of what is shown. */
  readonly presented = new PresentedInstant();
  /** Clouds wait here for the videos that were captured with them. */
  readonly hold: CloudHold;
  /** Paints clouds with the video of their camera. */
  readonly videoColour: VideoColour;
  /** The robot's telemetry over time. */
  readonly recorder: TelemetryRecorder;
  readonly vr: VrSession;
  /** Leads the view by the operator's commands. */
  readonly predicted: PredictedView;
  readonly frames: FrameLoop;
  readonly near: NearFieldDisplay;
  /** Plays the robot's microphone. */
  readonly player = new SoundPlayer();
  readonly #sound: SoundUi;
  readonly #inputs: OperatorInputs;
  readonly #controls: ControlsUi;
  readonly #cloudPanel: CloudPanel;
  /** The panel on the wrist in VR. */
  wrist: WristPanel | null = null;
  #headset: HeadsetControls | null = null;
  readonly #release = new ReleaseHold();
  readonly #left = new AwayRelease();
  readonly #estop: EstopUi;
  readonly #access: AccessUi;

  /** @param openLink of tests @throws {Error} without WebGL 2 */
  constructor(settings: Settings, transform: TransformSupport, notices: Notices, openLink?: OpenLink) {
    this.settings = settings;
    this.stage = new Stage(elements.stage, settings.canvas, settings.headset);
    const { renderer, world } = this.stage;
    this.appearance = openAppearance(settings, renderer.getContext());
    const inputPort = {
      onChange: () => this.client.driver.tick(performance.now()),
      onAction: (action, timeMs) => this.#controls.act(action, timeMs),
      onRelease: (control, held) => this.#estop.hold(control, held),
      onTalk: (control, held) => this.#sound.hold(control, held),
      mayDrive: () => this.state.link.live.value,
    } satisfies InputPort;
    this.#inputs = new OperatorInputs(inputPort, settings.headset.driveHand, notices);
    const { signalingUrl, name, token, icePolicy, bridge, mode } = settings;
    const receiver = videoReceiver(settings.videoReceiver);
    const origin = tokenOrigin(signalingUrl);
    const access = new OperatorAccess(browserAccess(origin), () => Date.now() / 1000);
    const knownRobots = new StoredRobots(origin);
    this.client = new RobotClient({
      signalingUrl,
      name,
      token,
      icePolicy,
      transform,
      bridge,
      knownRobots,
      openLink,
      credentials: () => access.credentials(),
      cloudFormats: mode === 'points64' ? ['points64'] : undefined,
      inputs: this.#inputs.all,
      ...(receiver?.adopt === undefined ? {} : { onVideoReceiver: receiver.adopt }),
    });
    // Before the clouds' views, which may release what it reads.
    this.predicted = new PredictedView(this.client, settings.predict);
    this.stage.predicted = this.predicted;
    this.state = new PageState({
      client: this.client,
      settings,
      notices,
      figures: () => this.figures(),
      placements: new PanelPlacements(loadPlacements(), storePlacements),
      now: () => performance.now(),
      newCanvas: () => document.createElement('canvas'),
    });
    const { sensors, pointScale } = this.state;
    this.videos = new VideoFeed({
      client: this.client,
      views: this.state.videos,
      synchronised: settings.synchronised,
      receiver,
      words: videoWords,
      presented: this.presented,
      now: () => performance.now(),
      onShown: (captureMs) => this.client.seen.onShown(captureMs),
    });
    this.recorder = new TelemetryRecorder(this.client, () => performance.now());
    this.hold = new CloudHold(settings.synchronised ? driverHold : noHold);
    const held = new HeldClouds(this.client, this.hold, () => performance.now());
    this.cloud = new CloudView(renderer, held);
    world.add(this.cloud);
    this.remembered = new RememberedWorld({ renderer, world, client: this.client, held });
    this.clouds = new SensorClouds({ renderer, world, client: held, first: this.cloud, sensors, pointScale });
    this.videoColour = new VideoColour({
      client: this.client,
      feed: this.videos,
      hold: this.hold,
      views: this.state.videos,
      clouds: this.clouds.all,
      wanted: this.appearance.paint,
      synchronised: settings.synchronised,
    });
    this.vr = new VrSession(renderer, settings.headset);
    this.#access = new AccessUi({
      access,
      knownRobots,
      client: this.client,
      link: this.state.link,
      signIn: new SignIn(tabStorage(), origin),
      tell: ({ text, tone }) => notices.tell(text, tone),
    });
    this.#estop = new EstopUi(this.client, this.state.robot, this.#release);
    const { client, state, stage, cloud, clouds, videos, stats, vr, appearance, recorder, presented } = this;
    this.near = new NearFieldDisplay(client, stage, vr.active);
    const choose = (robotId: string) => this.choose(robotId);
    const dashboard = new DashboardOpener({ client, state, settings, recorder, presented, inVr: vr.active });
    const toggleDashboard = () => dashboard.toggle();
    this.#controls = new ControlsUi({
      client,
      state,
      stage,
      vr,
      appearance,
      estop: this.#estop,
      choose,
      toggleDashboard,
      nextHeadsetView: () => this.#headset?.nextView(),
      predicted: this.predicted,
    });
    const memory = { remembered: this.remembered, tell: notices.tell.bind(notices) };
    this.#cloudPanel = new CloudPanel({ appearance, sensors, views: clouds.all, memory, robot: state.robot });
    this.#sound = new SoundUi({
      client,
      player: this.player,
      state: state.sound,
      tell: ({ text, tone }) => notices.tell(text, tone),
    });
    const readHeadset = () => this.#headset?.read();
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
      remembered: this.remembered,
    });
  }

  start(): void {
    this.#listen();
    listenToCanvas(elements.stage, this.stage, this.state.notices);
    this.#controls.start();
    this.#sound.start();
    this.#access.start();
    this.client.start();
    if (this.settings.robot !== null) this.client.choose(this.settings.robot);
    this.#show();
    setInterval(() => {
      const nowMs = performance.now();
      this.frames.tick(nowMs);
      this.#inputs.poll(nowMs);
      const away = this.#handsAway();
      this.#estop.tick(nowMs, away);
      const { driver } = this.client;
      driver.suspended = away || this.state.driving.role.value === 'watch';
      if (this.#left.tick(this.vr.active.value ? this.vr.hidden : document.hidden, nowMs))
        driver.letGo(nowMs);
      this.client.tick(performance.now());
      showRobotModel(this.client, this.stage, this.appearance);
      showDrivePath(this.client, this.stage);
      showNavigation(this.client, this.stage, this.appearance, nowMs);
      this.near.tick(nowMs);
    }, DRIVE_TICK_MS);
    setInterval(() => {
      const nowMs = performance.now();
      this.stats.tick(this.cloud, nowMs);
      this.stats.remembered = this.remembered.tick(nowMs);
      this.videoColour.tick(nowMs);
      this.videos.measure(nowMs);
      this.state.looking.value = this.vr.active.value || !document.hidden;
      this.state.sample();
      this.#cloudPanel.update();
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
    const shown = { canvas: this.stage.renderer.domElement, videos: this.videos.stats(nowMs) };
    const ageMs = viewAgeMs(this.client, nowMs);
    const stats = this.stats.snapshot(this.client.stats(), this.cloud, { ...shown, viewAgeMs: ageMs });
    return { ...stats, view: this.predicted.figures, videoColour: this.videoColour.figures };
  }

  #show(): void {
    const { state, stage, vr } = this;
    const { pointScale } = state;
    const choose = (robotId: string) => this.choose(robotId);
    state.sample();
    showStatus(state);
    showNearWords(state);
    showRobotList(state.link, choose);
    showRobotSwitcher(state.link, choose);
    showPeople(state, this.client);
    showSensorSwitches(state.sensors);
    showPicturePanels(state, { inVr: vr.active, isGripped: () => this.client.driver.stream.held });
    const { appearance, clouds } = this;
    const [inVr, { headset }] = [vr.active, stage];
    applyAppearance({
      appearance,
      sensors: state.sensors,
      rings: state.rings,
      clouds,
      stage,
      inVr,
      inTabletop: computed(() => headset.view.value === 'tabletop'),
      client: this.client,
      remembered: this.remembered,
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
      this.cloud.sizeScale = pointScale.value;
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
      this.clouds.ground = pose.position.z;
    });
    tellNotices(client, this.state.notices);
    if (this.settings.cues) giveCues(client, this.vr, () => performance.now());
  }
}
