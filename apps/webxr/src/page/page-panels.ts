/** The panels, dialogs and controls of the page, and what they do. */
import type { RobotClient } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { OperatorAccess } from '../ground/access/operator-access.ts';
import { SignIn, tabStorage } from '../ground/access/sign-in.ts';
import type { StoredRobots } from '../ground/access/stored-robots.ts';
import type { EventLog } from '../ground/events/event-log.ts';
import type { LiveSettings } from '../ground/live-settings.ts';
import type { LastPictures } from '../ground/pictures/last-pictures.ts';
import type { SessionReports } from '../ground/report/session-reports.ts';
import type { TelemetryRecorder } from '../ground/telemetry/recorder.ts';
import { CaptureUi } from '../panels/capture/capture-ui.ts';
import { feelDone } from '../panels/cues/cues.ts';
import { DashboardOpener } from '../panels/dashboard/dashboard-opener.ts';
import { EventsOpener } from '../panels/events/events-opener.ts';
import { Guide } from '../panels/help/guide.ts';
import { startInputsDialog } from '../panels/inputs/inputs-opener.ts';
import { showKeyHints } from '../panels/inputs/key-hints.ts';
import { showSpeedChoice } from '../panels/inputs/speed-controls.ts';
import { AccessUi } from '../panels/ui/access-ui.ts';
import { listenToCanvas } from '../panels/ui/canvas-events.ts';
import { CloudPanel } from '../panels/ui/cloud-panel.ts';
import { showCommands } from '../panels/ui/commands-panel.ts';
import { ControlsUi } from '../panels/ui/controls-ui.ts';
import { elements } from '../panels/ui/elements.ts';
import { EstopUi } from '../panels/ui/estop-ui.ts';
import { showNearWords } from '../panels/ui/near-panel.ts';
import type { OperatorInputs } from '../panels/ui/operator-inputs.ts';
import { keepRobotInAddress, showTitle } from '../panels/ui/page-title.ts';
import { showPeople } from '../panels/ui/people-panel.ts';
import { showPicturePanels } from '../panels/ui/picture-panels.ts';
import { PointingUi } from '../panels/ui/pointing-ui.ts';
import { showRobotList } from '../panels/ui/robot-list.ts';
import { showRobotSwitcher } from '../panels/ui/robot-switcher.ts';
import { showSensorSwitches } from '../panels/ui/sensor-switches.ts';
import { SoundUi } from '../panels/ui/sound-ui.ts';
import { showStagesLine } from '../panels/ui/stages-line.ts';
import { showStatus } from '../panels/ui/status-ui.ts';
import type { Stage } from '../scene/view/stage.ts';
import type { VrSession } from '../scene/view/vr-session.ts';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import type { PageState } from '../state/page-state.ts';
import type { ReleaseHold } from '../take/drive/release-hold.ts';
import { inputSettings } from '../take/drive/stored-inputs.ts';
import type { SoundPlayer } from '../take/sound/sound-player.ts';
import type { Words } from '../words/words.ts';
import type { PageViews } from './page-views.ts';

export interface PagePanelsParts {
  readonly client: RobotClient;
  readonly access: OperatorAccess;
  readonly knownRobots: StoredRobots;
  /** Of the signaling service. */
  readonly origin: string;
  /** How each robot was last seen here. */
  readonly pictures: LastPictures;
  readonly settings: LiveSettings;
  readonly state: PageState;
  readonly events: EventLog;
  readonly reports: SessionReports;
  readonly stage: Stage;
  readonly appearance: CloudAppearance;
  readonly views: PageViews;
  readonly recorder: TelemetryRecorder;
  readonly vr: VrSession;
  readonly player: SoundPlayer;
  readonly release: ReleaseHold;
  readonly inputs: Pick<OperatorInputs, 'pause'>;
  /** Connects to this robot. */
  choose(robotId: string): void;
  /** Shows the next view in the headset. */
  nextHeadsetView(): void;
  /** Calls `act` once, in the next display frame, after drawing and before the frame is shown. */
  afterNextFrame(act: () => void): void;
}

export class PagePanels {
  readonly estop: EstopUi;
  readonly controls: ControlsUi;
  readonly sound: SoundUi;
  readonly pointing: PointingUi;
  readonly cloudPanel: CloudPanel;
  readonly capture: CaptureUi;
  readonly #access: AccessUi;
  readonly #events: EventsOpener;
  readonly #guide: Guide;
  readonly #parts: PagePanelsParts;

  constructor(parts: PagePanelsParts) {
    this.#parts = parts;
    const { client, access, knownRobots, origin, settings, state, stage, appearance, views, vr } = parts;
    const tell = ({ text, tone }: Words) => state.notices.tell(text, tone);
    const { link } = state;
    this.#access = new AccessUi({
      access,
      knownRobots,
      client,
      link,
      signIn: new SignIn(tabStorage(), origin),
      tell,
    });
    this.estop = new EstopUi(client, state, parts.release);
    this.pointing = new PointingUi({
      client,
      stage,
      notices: state.notices,
      feel: () => feelDone(settings, null),
    });
    const { recorder } = parts;
    const { presented, predicted, clouds, remembered } = views;
    const dashboard = new DashboardOpener({ client, state, settings, recorder, presented, inVr: vr.active });
    this.#guide = new Guide({ client, state, settings, inputs: parts.inputs, inVr: vr.active });
    showStagesLine(client, state, () => dashboard.openStages());
    const { afterNextFrame } = parts;
    this.capture = new CaptureUi({ state, settings, inVr: vr.active, afterNextFrame });
    const { capture } = this;
    this.#events = new EventsOpener({
      log: parts.events,
      reports: parts.reports,
      notices: state.notices,
      capture,
    });
    this.controls = new ControlsUi({
      client,
      state,
      stage,
      vr,
      appearance,
      estop: this.estop,
      choose: parts.choose,
      toggleDashboard: () => dashboard.toggle(),
      openEvents: () => void this.#events.toggle(),
      capture,
      toggleHelp: () => this.#guide.toggleHelp(),
      nextHeadsetView: parts.nextHeadsetView,
      point: () => this.pointing.point(),
      predicted,
      settings,
    });
    const memory = { remembered, tell: state.notices.tell.bind(state.notices) };
    const { sensors, robot } = state;
    this.cloudPanel = new CloudPanel({ appearance, sensors, views: clouds.all, memory, robot });
    this.sound = new SoundUi({ client, player: parts.player, state: state.sound, tell });
  }

  /** Lets hands reach the controls. Call it before the client starts. */
  start(): void {
    const { stage, state, inputs } = this.#parts;
    const { maxLinear, goesSideways } = state.robot;
    effect(() => {
      inputSettings.goesSideways.value = goesSideways.value;
    });
    this.#guide.start(startInputsDialog({ inputs, settings: inputSettings, maxLinear }, state.notices));
    showSpeedChoice(inputSettings.speed, maxLinear, state.driving.role);
    listenToCanvas(elements.stage, stage, state.notices);
    this.controls.start();
    this.pointing.start(elements.stage);
    this.sound.start();
    this.#access.start();
    this.#events.start();
    this.capture.start();
  }

  /** Draws the state in the document from now on. */
  show(): void {
    const { client, state, vr, choose, pictures } = this.#parts;
    showTitle(state.link);
    showKeyHints();
    keepRobotInAddress(state.link);
    showStatus(state);
    showNearWords(state);
    // Only the list shows what robots tell, and it is shown without a session.
    effect(() => client.link.statusFeed.watchStatuses(!state.link.connected.value));
    showRobotList(state.link, pictures, choose);
    showRobotSwitcher(state.link, choose);
    showPeople(state, client);
    showCommands(state.commands);
    showSensorSwitches(state.sensors);
    showPicturePanels(state, { inVr: vr.active, isGripped: () => client.driver.stream.held });
  }
}
