/** The page: shows on the screen what the robot sends, and sends the robot what the operator's hands do. */
import type { RobotClient, RobotClientOptions, TransformSupport } from '@farpoint/operator';
import { EventLog } from '../ground/events/event-log.ts';
import type { LiveSettings } from '../ground/live-settings.ts';
import { PanelPlacements } from '../ground/panels/panel-placements.ts';
import { loadPlacements, storePlacements } from '../ground/panels/stored-panels.ts';
import { SessionReports } from '../ground/report/session-reports.ts';
import { TelemetryRecorder } from '../ground/telemetry/recorder.ts';
import { answerWall } from '../panels/ui/answer-wall.ts';
import { elements } from '../panels/ui/elements.ts';
import { OperatorInputs } from '../panels/ui/operator-inputs.ts';
import { NearFieldDisplay } from '../panels/ui/show-near-field.ts';
import type { NoticeSign } from '../scene/headset/notice-sign.ts';
import { PredictedView } from '../scene/view/predicted-view.ts';
import { showRobot } from '../scene/view/show-robot.ts';
import { Stage } from '../scene/view/stage.ts';
import { VrSession } from '../scene/view/vr-session.ts';
import type { WristPanel } from '../scene/view/wrist-panel.ts';
import { type CloudAppearance, openAppearance } from '../state/cloud-appearance.ts';
import type { Notices } from '../state/notices.ts';
import { PageState } from '../state/page-state.ts';
import { readKeyboardLayout } from '../take/drive/keyboard-layout.ts';
import { ReleaseHold } from '../take/drive/release-hold.ts';
import { SoundPlayer } from '../take/sound/sound-player.ts';
import { texts } from '../words/language.ts';
import { viewAgeMs } from '../words/motion-words.ts';
import { PageStatistics, type PageStats } from '../words/page-stats.ts';
import { FrameLoop } from './frame-loop.ts';
import type { HeadsetControls } from './headset-controls.ts';
import { keepPictures } from './keep-pictures.ts';
import { logPage } from './log-page.ts';
import { openClient } from './open-client.ts';
import { PagePanels } from './page-panels.ts';
import { PageViews } from './page-views.ts';
import { followRobot, type ShownParts, showPage } from './show-page.ts';
import { SteadyWork } from './steady-work.ts';

export class App implements ShownParts {
  readonly settings: LiveSettings;
  readonly state: PageState;
  readonly stage: Stage;
  readonly client: RobotClient;
  /** Clouds, videos, and what was seen before. */
  readonly views: PageViews;
  readonly appearance: CloudAppearance;
  /** What has happened. */
  readonly events = new EventLog(() => Date.now());
  readonly reports = new SessionReports();
  readonly stats = new PageStatistics();
  readonly vr: VrSession;
  readonly frames: FrameLoop;
  readonly near: NearFieldDisplay;
  /** Plays the robot's microphone. */
  readonly player = new SoundPlayer();
  readonly inputs: OperatorInputs;
  readonly panels: PagePanels;
  /** The panel on the wrist in VR. */
  wrist: WristPanel | null = null;
  /** The sign before the eyes in VR. */
  sign: NoticeSign | null = null;
  headset: HeadsetControls | null = null;
  readonly #release = new ReleaseHold();
  readonly releaseProgress = this.#release.progress;

  /** @param openLink of tests @throws {Error} without WebGL 2 */
  constructor(
    settings: LiveSettings,
    transform: TransformSupport,
    notices: Notices,
    openLink?: RobotClientOptions['openLink'],
  ) {
    this.settings = settings;
    const stage = new Stage(elements.stage, settings.canvas, settings.headset);
    this.stage = stage;
    const appearance = openAppearance(stage.renderer.getContext());
    this.appearance = appearance;
    this.inputs = this.#openInputs(notices);
    const { client, receiver, ...opened } = openClient({
      settings,
      transform,
      inputs: this.inputs,
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
      isOnline: () => navigator.onLine,
      newCanvas: () => document.createElement('canvas'),
    });
    const { state, stats, player } = this;
    const views = new PageViews({ client, settings, stage, state, appearance, predicted, receiver });
    this.views = views;
    const vr = new VrSession(stage.renderer, settings.headset);
    this.vr = vr;
    this.near = new NearFieldDisplay(client, stage, vr.active);
    this.panels = new PagePanels({
      ...opened,
      client,
      settings,
      state,
      events: this.events,
      reports: this.reports,
      stage,
      appearance,
      views,
      recorder: new TelemetryRecorder(client, () => performance.now()),
      vr,
      player,
      release: this.#release,
      inputs: this.inputs,
      choose: (robotId) => this.choose(robotId),
      nextHeadsetView: () => this.headset?.nextView(),
      afterNextFrame: (act) => this.frames.afterNextFrame(act),
    });
    const readHeadset = () => this.headset?.read();
    this.frames = new FrameLoop({ settings, client, stage, views, stats, vr, readHeadset });
    keepPictures({ client, stage, frames: this.frames, pictures: opened.pictures });
  }

  #openInputs(notices: Notices): OperatorInputs {
    return new OperatorInputs(
      {
        onChange: () => this.client.driver.sendDue(performance.now()),
        onAction: (action, timeMs) => this.panels.controls.act(action, timeMs),
        onRelease: (control, held) => this.panels.estop.hold(control, held),
        onTalk: (control, held) => this.panels.sound.hold(control, held),
        mayDrive: () => this.state.link.live.value,
      },
      this.settings.headset,
      notices,
    );
  }

  start(): void {
    const { client, settings, panels } = this;
    void readKeyboardLayout(navigator);
    followRobot(this);
    panels.capture.onSaved = logPage(this);
    panels.start();
    client.start();
    if (settings.robot !== null) client.choose(settings.robot);
    answerWall(this.state, () => panels.estop.stop());
    const { panel, sign, controls } = showPage(this);
    this.wrist = panel;
    this.sign = sign;
    this.headset = controls;
    const { estop, cloudPanel } = panels;
    const drawRobot = (nowMs: number) => {
      showRobot(this, nowMs);
      panels.pointing.show(nowMs);
    };
    new SteadyWork({ ...this, estop, cloudPanel, showRobot: drawRobot }, document).start();
    this.frames.start();
  }

  /** Connects to this robot. A robot that was chosen before is stopped first. */
  choose(robotId: string): void {
    this.client.choose(robotId);
    if (this.client.chosenRobotId !== this.client.link.robotId)
      this.state.notices.tell(texts().driving.leaving);
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
}
