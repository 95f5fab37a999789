/** The page: what comes from the robot to the screen, what comes from the hands to the robot. */
import { CLOUD_FORMATS, type CloudFormat } from '@farpoint/protocol';
import { BridgeLink } from './bridge/bridge-link.ts';
import { Batch } from './cloud/batch.ts';
import { CloudView } from './cloud/cloud-view.ts';
import type { FromCloudWorker, ToCloudWorker } from './cloud/worker-messages.ts';
import { Driver } from './drive/driver.ts';
import { type PresentRobot, RobotSwitch } from './drive/robot-switch.ts';
import { ScriptInput } from './drive/script-input.ts';
import { LatencyProbe } from './latency/latency-probe.ts';
import type { PacketRecord } from './latency/packet-record.ts';
import type { PageLink } from './link/page-link.ts';
import { RobotLink, type RobotLinkEvents } from './link/robot-link.ts';
import type { PageParts } from './page-parts.ts';
import type { TransformSupport } from './peer/encoded-transform.ts';
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
import { StatusUi } from './ui/status-ui.ts';
import { DrawGate } from './view/draw-gate.ts';
import { DrawingGovernor } from './view/drawing-governor.ts';
import { GpuCompletion } from './view/gpu-completion.ts';
import { Stage } from './view/stage.ts';
import { VrSession } from './view/vr-session.ts';
import { WristPanel } from './view/wrist-panel.ts';

const POINTS64_ONLY: readonly CloudFormat[] = ['points64'];
const DRIVE_TICK_MS = 25;
const STATUS_TICK_MS = 250;
/** Without points for so long the picture begins to turn grey, and so much later it is. */
const STALE_AFTER_MS = 600;
const STALE_FADE_MS = 1400;

export class App implements PageParts {
  readonly settings: Settings;
  readonly stage: Stage;
  readonly cloud: CloudView;
  readonly link: PageLink;
  readonly driver: Driver;
  readonly inputs: OperatorInputs;
  readonly script = new ScriptInput();
  readonly stats: PageStatistics;
  readonly latency: LatencyProbe;
  readonly vr: VrSession;
  readonly cameras: CameraViews;
  readonly #worker: Worker;
  readonly #completion: GpuCompletion;
  readonly #gate = new DrawGate();
  readonly #status: StatusUi;
  readonly #estop = new EstopUi(this);
  readonly #drawing = new DrawingGovernor();
  readonly #switch = new RobotSwitch({
    letGo: () => this.driver.letGo(performance.now()),
    connect: (robotId) => this.link.connect(robotId),
  });
  #generation = 0;
  /** Streams of these came that this page cannot decode: it asks for none any more. */
  readonly #refusedFormats = new Set<CloudFormat>();
  lastPointsMs = 0;
  /** Filled while a measurement asks for it. */
  packetRecord: PacketRecord | null = null;
  #pixelWaiters: (() => void)[] = [];

  /** @throws {Error} without WebGL 2 */
  constructor(settings: Settings, transform: TransformSupport) {
    this.settings = settings;
    this.stage = new Stage(elements.stage, settings.canvas);
    const { renderer } = this.stage;
    this.#completion = new GpuCompletion(renderer);
    this.#completion.onCost = (costMs) => this.#gate.onCost(costMs);
    this.#worker = new Worker(new URL('./cloud/cloud-worker.ts', import.meta.url), { type: 'module' });
    this.stats = new PageStatistics((captureUs, nowMs) => this.link.session.ageMs(captureUs, nowMs));
    this.cloud = new CloudView(this.stage.gl, {
      onPacket: (batch, packet) => {
        this.stats.onPacket(batch, packet);
        this.latency.onPacket(batch, packet);
      },
      onDone: (buffer) => {
        const message: ToCloudWorker = { type: 'return', buffer };
        this.#worker.postMessage(message, [buffer]);
      },
    });
    this.cloud.sizeScale = settings.pointScale;
    this.stage.world.add(this.cloud.object);
    this.link = this.#makeLink(transform);
    this.inputs = new OperatorInputs(() => this.driver.tick(performance.now()));
    this.driver = new Driver([...this.inputs.all, this.script], {
      sendCommand: (command) => this.link.sendCommand(command),
      sendSession: (message) => this.link.sendSession(message),
      onOtherDrives: () => notify(rejectionWords['not-lease-holder'], 'warning'),
    });
    this.latency = new LatencyProbe(this.link, this.driver, (result) => {
      this.stats.onResult(result);
      const { id, frameNumber, mtpMs, firstMs } = result;
      this.link.sendSession({ type: 'latencyMeasured', id, frameNumber, mtpMs, firstMs });
    });
    this.vr = new VrSession(renderer, (active) => this.#onVr(active));
    this.cameras = new CameraViews((stampUs, nowMs) => this.link.session.ageMs(stampUs, nowMs), {
      onChange: () => this.#status.onCameras(),
      onWatch: (cameras) => this.link.sendSession({ type: 'pictures', cameras }),
      onPicture: () => this.#status.updatePictures(performance.now()),
    });
    this.#status = new StatusUi(this, new WristPanel(renderer, this.stage.rig), this.cameras);
  }

  start(): void {
    this.#listenToWorker();
    if (this.settings.drawEvery !== null) this.#drawEvery(this.settings.drawEvery, this.settings.drawEvery);
    this.#listenToCanvas();
    const controls = new ControlsUi(this, this.#estop);
    controls.start();
    this.inputs.onAction = (action, timeMs) => controls.act(action, timeMs);
    this.inputs.onRelease = (control, held) => this.#estop.hold(control, held);
    this.link.start();
    if (this.settings.robot !== null) this.link.connect(this.settings.robot);
    setInterval(() => {
      this.inputs.poll();
      const away = this.#handsAway();
      this.#estop.tick(performance.now(), away);
      if (this.vr.active) this.#status.showRelease(this.#estop.progress);
      this.driver.suspended = away;
      this.driver.tick(performance.now());
      this.#switch.tick(this.#presentRobot, performance.now());
      this.latency.tick(performance.now());
    }, DRIVE_TICK_MS);
    setInterval(() => {
      const nowMs = performance.now();
      this.stats.tick(this.cloud, nowMs);
      this.cameras.looking = this.vr.active || !document.hidden;
      this.#status.update(nowMs);
      this.#governDrawing(nowMs);
    }, STATUS_TICK_MS);
    this.stage.renderer.setAnimationLoop((nowMs) => this.#frame(nowMs));
  }

  get chosenRobotId(): string | null {
    return this.#switch.target ?? this.link.robotId;
  }

  /** Connects to this robot; another one is left standing first. */
  choose(robotId: string): void {
    this.#switch.choose(robotId, this.#presentRobot, performance.now());
    if (this.#switch.target !== null) notify(leavingWords);
    this.#status.update(performance.now());
  }

  leave(): void {
    this.#switch.cancel();
    this.link.disconnect();
  }

  get #presentRobot(): PresentRobot {
    const { telemetry } = this.link.session;
    const speed =
      telemetry === null
        ? null
        : Math.max(Math.abs(telemetry.twist.linear.x), Math.abs(telemetry.twist.angular.z));
    return {
      robotId: this.link.robotId,
      live: this.link.phase === 'live',
      holder: this.driver.holder,
      speed,
    };
  }

  /** Resolves within the next display frame, after it was drawn and before it is shown. */
  afterNextFrame(act: () => void): void {
    this.#pixelWaiters.push(act);
  }

  #frame(nowMs: number): void {
    // In VR the headset's compositor keeps the pace.
    if (!this.vr.active && this.#completion.busy) return;
    const began = performance.now();
    this.cloud.update();
    if (!this.vr.active && !this.#gate.mayDraw(this.cloud.window.endedFrame, began)) return;
    this.#gate.onDraw(this.cloud.window.endedFrame, began);
    const { renderer, scene, camera } = this.stage;
    if (this.vr.active) this.inputs.readHeadset(this.vr.inputSources);
    const stale = (began - this.lastPointsMs - STALE_AFTER_MS) / STALE_FADE_MS;
    this.cloud.freshness = 1 - Math.min(Math.max(stale, 0), 1);
    this.stage.prepare(this.cloud, nowMs);
    renderer.render(scene, camera);
    // Only where a time is taken: waiting for the GPU costs frames.
    if (this.latency.wantsTime || this.settings.canvas !== null) {
      this.#completion.wait();
      this.#gate.onCost(performance.now() - began);
    } else if (!this.vr.active) this.#completion.mark();
    const ended = performance.now();
    this.latency.onDrawn(ended);
    this.stats.onDrawn(ended, ended - began);
    if (this.#pixelWaiters.length > 0) {
      for (const act of this.#pixelWaiters) act();
      this.#pixelWaiters = [];
    }
  }

  #governDrawing(nowMs: number): void {
    if (document.hidden || this.link.phase !== 'live') this.#drawing.pause();
    else if (this.#drawing.update(this.stats.displayFramesPerSecond, nowMs)) {
      const { scale, every } = this.#drawing.step;
      this.stage.resolution = scale;
      // A sample of a cloud is not thinned further: a few thousand points are not what is slow.
      if (this.settings.drawEvery === null) this.#drawEvery(every, 1);
    }
  }

  #drawEvery(every: number, everySample: number): void {
    const message: ToCloudWorker = { type: 'drawEvery', every, everySample };
    this.#worker.postMessage(message);
  }

  /** Which of our formats we read; the robot chooses. */
  #tellFormats(): void {
    const readable = this.settings.mode === 'points64' ? POINTS64_ONLY : CLOUD_FORMATS;
    const formats = readable.filter((format) => !this.#refusedFormats.has(format));
    this.link.sendSession({ type: 'cloudFormats', formats });
  }

  /** Commands may only come from hands that see what they do. */
  #handsAway(): boolean {
    if (this.vr.active) return this.vr.hidden;
    return document.hidden || !document.hasFocus();
  }

  #makeLink(transform: TransformSupport): PageLink {
    const { signalingUrl, name, token, icePolicy, bridge } = this.settings;
    const events: RobotLinkEvents = {
      onSignaling: () => this.#status.update(performance.now()),
      onRobots: (robots) => showRobots(robots, (robotId) => this.choose(robotId)),
      onPhase: (phase) => {
        if (phase === 'none') {
          this.cloud.reset();
          this.stage.forgetPose();
        }
        if (phase !== 'live') {
          this.driver.reset();
          this.latency.fail('no-session');
        }
        this.lastPointsMs = performance.now();
        this.#status.update(performance.now());
      },
      onLoss: (loss) => notify(wordsOfLoss(loss, this.link.maxOperators), 'warning'),
      onPath: () => {
        this.driver.onPath(performance.now());
        this.#status.update(performance.now());
      },
      onGeneration: (generation) => {
        this.#generation = generation;
        this.cameras.setCameras([]);
        this.cloud.reset();
        this.stats.reset();
        this.stage.forgetPose();
      },
      onRefusal: (message) => notify(message, 'warning'),
      onWelcome: (welcome) => {
        this.#tellFormats();
        this.driver.onLimits(welcome.limits);
        notify(`Connected to ${welcome.name}`, 'good');
      },
      onLease: (lease) => {
        this.driver.onLease(lease);
        this.latency.onLease();
        this.#status.update(performance.now());
      },
      onRejected: (rejected) => {
        console.info('command refused:', rejected.reason, rejected.detail);
        notify(rejectionWords[rejected.reason], 'warning');
      },
      onEstop: () => this.#status.update(performance.now()),
      onLatencyFrame: (frame) => this.latency.onRobotFrame(frame),
      onCloudStream: ({ format, header }) => {
        const bytes = Uint8Array.from(atob(header), (character) => character.charCodeAt(0));
        const message: ToCloudWorker = {
          type: 'cloudStream',
          generation: this.#generation,
          format,
          header: bytes,
        };
        this.#worker.postMessage(message, [bytes.buffer]);
      },
      onCameras: (cameras) => this.cameras.setCameras(cameras),
      onPicture: (picture, nowMs) => this.cameras.add(picture, nowMs),
      onTelemetry: (telemetry) => this.stage.setBody(telemetry.pose),
      onRobotFault: (message) => notify(`The robot says: ${message}`, 'warning'),
    };
    if (bridge !== null) return new BridgeLink(bridge, this.#worker, events);
    const options = { signalingUrl, name, token, icePolicy, worker: this.#worker, transform };
    return new RobotLink(options, events);
  }

  #listenToWorker(): void {
    this.#worker.onmessage = ({ data: message }: MessageEvent<FromCloudWorker>) => {
      switch (message.type) {
        case 'batch': {
          const batch = new Batch(message.buffer, message.packets, message.points);
          this.packetRecord?.add(batch, performance.timeOrigin);
          // Of an earlier session, or nobody would draw it.
          if (message.generation !== this.#generation || (document.hidden && !this.vr.active)) {
            const back: ToCloudWorker = { type: 'return', buffer: message.buffer };
            this.#worker.postMessage(back, [message.buffer]);
          } else {
            this.cloud.enqueue(batch);
          }
          const nowMs = performance.now();
          if (message.generation === this.#generation) {
            this.lastPointsMs = nowMs;
            this.link.onPoints(nowMs);
          }
          return;
        }
        case 'report':
          if (message.generation !== this.#generation) return;
          this.stats.onReport(message);
          this.link.sendReport(message);
          return;
        case 'streamRefused':
          if (message.generation !== this.#generation) return;
          console.warn('cloud stream:', message.format, message.message);
          this.#refusedFormats.add(message.format);
          this.#tellFormats();
          return;
        case 'failed':
          console.error('cloud worker:', message.message);
          showFailure(failureWords.workerFailed);
          return;
        case 'ready':
      }
    };
    this.#worker.onerror = () => showFailure(failureWords.workerFailed);
  }

  #listenToCanvas(): void {
    new ResizeObserver(() => this.stage.resize()).observe(elements.stage);
    elements.stage.addEventListener('webglcontextlost', () => showFailure(failureWords.contextLost));
    elements.stage.addEventListener('webglcontextrestored', () => {
      this.cloud.recreate();
      showFailure(null);
    });
  }

  #onVr(active: boolean): void {
    this.inputs.releaseAll();
    this.#status.onVr(active);
    if (!active) this.stage.resize();
  }
}
