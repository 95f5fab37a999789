/** The page: what comes from the robot to the screen, what comes from the hands to the robot. */
import { CloudView } from '@farpoint/cloud-view';
import { RobotClient, type TransformSupport } from '@farpoint/operator';
import type { PageParts } from './page-parts.ts';
import { CameraViews } from './pictures/camera-views.ts';
import type { Settings } from './settings.ts';
import { PageStatistics } from './status/page-stats.ts';
import { failureWords, leavingWords, rejectionWords, wordsOfLoss } from './status/words.ts';
import { ControlsUi } from './ui/controls-ui.ts';
import { elements } from './ui/elements.ts';
import { EstopUi } from './ui/estop-ui.ts';
import { notify, showFailure } from './ui/notice.ts';
import { OperatorInputs } from './ui/operator-inputs.ts';
import { showRobots } from './ui/robot-list.ts';
import { showSensors } from './ui/sensor-switches.ts';
import { StatusUi } from './ui/status-ui.ts';
import { FrameLoop } from './view/frame-loop.ts';
import { SensorClouds } from './view/sensor-clouds.ts';
import { Stage } from './view/stage.ts';
import { VrSession } from './view/vr-session.ts';
import { WristPanel } from './view/wrist-panel.ts';

const DRIVE_TICK_MS = 25;
const STATUS_TICK_MS = 250;

export class App implements PageParts {
  readonly settings: Settings;
  readonly stage: Stage;
  readonly cloud: CloudView;
  /** Those of a robot with several sensors. */
  readonly clouds: SensorClouds;
  readonly client: RobotClient;
  readonly stats = new PageStatistics();
  readonly vr: VrSession;
  readonly cameras: CameraViews;
  readonly frames: FrameLoop;
  readonly #inputs: OperatorInputs;
  readonly #status: StatusUi;
  readonly #estop: EstopUi;

  /** @throws {Error} without WebGL 2 */
  constructor(settings: Settings, transform: TransformSupport) {
    this.settings = settings;
    this.stage = new Stage(elements.stage, settings.canvas);
    const { renderer } = this.stage;
    this.#inputs = new OperatorInputs(() => this.client.driver.tick(performance.now()));
    const { signalingUrl, name, token, icePolicy, bridge, mode } = settings;
    this.client = new RobotClient({
      ...{ signalingUrl, name, token, icePolicy, transform, bridge },
      cloudFormats: mode === 'points64' ? ['points64'] : undefined,
      inputs: this.#inputs.all,
    });
    this.cloud = new CloudView(renderer, this.client);
    this.cloud.sizeScale = settings.pointScale;
    this.stage.world.add(this.cloud);
    this.clouds = new SensorClouds({
      ...{ renderer, world: this.stage.world, client: this.client, first: this.cloud },
      onChange: () => showSensors(this.clouds),
    });
    this.clouds.sizeScale = settings.pointScale;
    this.vr = new VrSession(renderer, (active) => this.#onVr(active));
    this.cameras = new CameraViews({
      onChange: () => this.#status.onCameras(),
      onWatch: (cameras) => this.client.watch(cameras),
      onPicture: () => this.#status.updatePictures(performance.now()),
    });
    this.#estop = new EstopUi(this.client);
    this.#status = new StatusUi(this, new WristPanel(renderer, this.stage.rig), this.cameras);
    const readHeadset = () => this.#inputs.readHeadset(this.vr.inputSources);
    const { client, stage, cloud, clouds, stats, vr } = this;
    this.frames = new FrameLoop({ settings, client, stage, cloud, clouds, stats, vr, readHeadset });
  }

  start(): void {
    this.#listen();
    this.#listenToCanvas();
    const controls = new ControlsUi(this, this.#estop);
    controls.start();
    this.#inputs.onAction = (action, timeMs) => controls.act(action, timeMs);
    this.#inputs.onRelease = (control, held) => this.#estop.hold(control, held);
    this.client.start();
    if (this.settings.robot !== null) this.client.choose(this.settings.robot);
    setInterval(() => {
      this.#inputs.poll();
      const away = this.#handsAway();
      this.#estop.tick(performance.now(), away);
      if (this.vr.active) this.#status.showRelease(this.#estop.progress);
      this.client.driver.suspended = away;
      this.client.tick(performance.now());
    }, DRIVE_TICK_MS);
    setInterval(() => {
      const nowMs = performance.now();
      this.stats.tick(this.cloud, nowMs);
      this.cameras.looking = this.vr.active || !document.hidden;
      this.#status.update(nowMs);
      this.frames.govern(nowMs);
    }, STATUS_TICK_MS);
    this.frames.start();
  }

  /** Connects to this robot; another one is left standing first. */
  choose(robotId: string): void {
    this.client.choose(robotId);
    if (this.client.chosenRobotId !== this.client.link.robotId) notify(leavingWords);
    this.#updateStatus();
  }

  /** Commands may only come from hands that see what they do. */
  #handsAway(): boolean {
    if (this.vr.active) return this.vr.hidden;
    return document.hidden || !document.hasFocus();
  }

  #listen(): void {
    const { client, stage } = this;
    for (const type of ['signaling', 'path', 'lease', 'estop'] as const)
      client.on(type, () => this.#updateStatus());
    client.on('robots', (robots) => showRobots(robots, (robotId) => this.choose(robotId)));
    client.on('phase', (phase) => {
      if (phase === 'none') stage.forgetPose();
      this.#updateStatus();
    });
    client.on('session', () => {
      this.cameras.setCameras([]);
      this.clouds.setSensors([]);
      this.stats.reset();
      stage.forgetPose();
    });
    client.on('loss', (loss) => notify(wordsOfLoss(loss, client.link.maxOperators), 'warning'));
    client.on('refused', (message) => notify(message, 'warning'));
    client.on('welcome', ({ name }) => notify(`Connected to ${name}`, 'good'));
    client.on('commandRejected', ({ reason, detail }) => {
      console.info('command refused:', reason, detail);
      notify(rejectionWords[reason], 'warning');
    });
    client.on('otherDrives', () => notify(rejectionWords['not-lease-holder'], 'warning'));
    client.on('sensors', (sensors) => this.clouds.setSensors(sensors));
    client.on('cameras', (cameras) => this.cameras.setCameras(cameras));
    client.on('picture', (picture) => this.cameras.show(picture));
    client.on('pictureFault', ({ camera, detail }) => this.cameras.onFault(camera, detail));
    client.on('telemetry', ({ pose }) => stage.setBody(pose));
    client.on('robotFault', (message) => notify(`The robot says: ${message}`, 'warning'));
    client.on('failed', ({ detail }) => {
      console.error('cloud worker:', detail);
      showFailure(failureWords.workerFailed);
    });
  }

  #updateStatus(): void {
    this.#status.update(performance.now());
  }

  #listenToCanvas(): void {
    new ResizeObserver(() => this.stage.resize()).observe(elements.stage);
    elements.stage.addEventListener('webglcontextlost', () => showFailure(failureWords.contextLost));
    elements.stage.addEventListener('webglcontextrestored', () => showFailure(null));
  }

  #onVr(active: boolean): void {
    this.#inputs.releaseAll();
    this.#status.onVr(active);
    if (!active) this.stage.resize();
  }
}
