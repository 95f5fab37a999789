/** The frame loop. Decides when a picture is drawn, and how coarsely if the machine cannot keep up. */
import {
  ALL_FRAMES_PER_SECOND,
  DisplayMeter,
  DrawGate,
  DrawingGovernor,
  GpuCompletion,
  isSoftwareRenderer,
  WorstGap,
} from '@farpoint/cloud-view';
import type { RobotClient } from '@farpoint/operator';
import type { Settings } from '../ground/settings.ts';
import { followScene } from '../scene/view/follow-scene.ts';
import type { Stage } from '../scene/view/stage.ts';
import type { VrSession } from '../scene/view/vr-session.ts';
import { warmUp } from '../scene/view/warm-up.ts';
import type { PageStatistics } from '../words/page-stats.ts';
import type { PageViews } from './page-views.ts';

/** What is said of a computer that draws all that comes. */
const MOST_FRAMES_PER_SECOND = 240;
/** As many points as any sensor has; divided by the governor's thinning. */
const MOST_POINTS = 240_000;

export interface FrameLoopParts {
  readonly settings: Settings;
  readonly client: RobotClient;
  readonly stage: Stage;
  readonly views: PageViews;
  readonly stats: PageStatistics;
  readonly vr: VrSession;
  /** Called before each picture in VR, because controllers send no events. */
  readHeadset(): void;
}

export class FrameLoop {
  readonly #parts: FrameLoopParts;
  readonly #completion: GpuCompletion;
  readonly #gate = new DrawGate();
  readonly #governor: DrawingGovernor;
  readonly #meter = new DisplayMeter();
  readonly #gaps = new WorstGap();
  #afterDrawing: (() => void)[] = [];
  /** Whether all that this robot brings has been drawn once. */
  #isWarm = false;

  constructor(parts: FrameLoopParts) {
    this.#parts = parts;
    // A canvas of a fixed size is small, and there to be measured.
    const { canvas } = parts.settings;
    this.#governor = new DrawingGovernor(canvas === null && isSoftwareRenderer(parts.stage.gl));
    this.#completion = new GpuCompletion(parts.stage.renderer);
    this.#completion.onCost = (costMs) => this.#gate.onCost(costMs);
  }

  start(): void {
    const { client, settings, stage } = this.#parts;
    const { clouds } = this.#parts.views;
    if (settings.drawEvery !== null) {
      client.drawEvery(settings.drawEvery, settings.drawEvery);
      clouds.every = settings.drawEvery;
    }
    this.#thin();
    // Each session begins with a robot that knows nothing of this computer.
    client.on('welcome', () => {
      this.#isWarm = false;
      this.#tellDisplay();
    });
    stage.renderer.setAnimationLoop((nowMs) => this.#frame(nowMs));
  }

  /** Calls `act` in the next display frame, after drawing and before the frame is shown. */
  afterNextFrame(act: () => void): void {
    this.#afterDrawing.push(act);
  }

  /** Measures how late the page runs. Call this whenever the timer fires that reads the operator's hand. */
  measureGap(nowMs: number): void {
    this.#gaps.measure(nowMs);
  }

  /** Call this a few times a second. Draws less if the machine cannot keep up, and follows the scene that is seen. */
  govern(nowMs: number): void {
    const { client, stage, stats } = this.#parts;
    const { clouds } = this.#parts.views;
    followScene(stage, clouds.all.peek());
    if (document.hidden || client.phase !== 'live') {
      this.#governor.pause();
      this.#meter.pause();
      this.#gaps.pause();
      return;
    }
    const coarser = this.#governor.update(stats.possibleFramesPerSecond, nowMs, this.#gaps.at(nowMs));
    if (coarser) this.#thin();
    if (this.#meter.update(nowMs) || coarser) this.#tellDisplay();
  }

  /** Draws as much as the governor says. */
  #thin(): void {
    const { client, settings, stage, stats } = this.#parts;
    const { clouds } = this.#parts.views;
    const { scale, every } = this.#governor.step;
    stage.resolution = scale;
    // A sampled cloud is not thinned further: a few thousand points are not what slows the machine down.
    if (settings.drawEvery !== null) return;
    client.drawEvery(every);
    clouds.every = every;
    stats.drawnOneOf = clouds.drawnOneOf(every);
  }

  /** What is decoded and not seen delays what is: the robot sends no more than this computer draws. */
  #tellDisplay(): void {
    const { framesPerSecond } = this.#meter;
    const points = Math.ceil(MOST_POINTS / this.#governor.step.every);
    const all = framesPerSecond >= ALL_FRAMES_PER_SECOND;
    this.#parts.client.link.sendSession({
      type: 'display',
      framesPerSecond: all ? MOST_FRAMES_PER_SECOND : framesPerSecond,
      points,
    });
  }

  #frame(nowMs: number): void {
    const { client, views, settings, stage, stats, vr } = this.#parts;
    const { held, cloud, clouds, remembered, videos } = views;
    // Videos are shown beside the scene: they need not wait until it can be drawn again.
    const nowOnClockMs = performance.now();
    videos.present(nowOnClockMs);
    held.advance(videos.shownMs, nowOnClockMs);
    const inVr = vr.active.peek();
    // In VR the headset's compositor sets the pace.
    if (!inVr && this.#completion.busy) return;
    const beganMs = performance.now();
    cloud.update(beganMs);
    clouds.update(beganMs);
    if (!inVr && !this.#gate.mayDraw(cloud.endedFrame, beganMs)) {
      stats.onSpared();
      return;
    }
    this.#gate.onDraw(cloud.endedFrame, beganMs);
    if (inVr) this.#parts.readHeadset();
    stage.predicted?.update(performance.now());
    stage.prepare(cloud, nowMs);
    remembered.update(stage.viewCamera, cloud.colouring);
    if (!this.#isWarm && cloud.hasPoints && !inVr && !client.driver.isGripped) {
      this.#isWarm = true;
      warmUp(stage.renderer, stage.scene, stage.viewCamera);
    }
    stage.renderer.render(stage.scene, stage.viewCamera);
    // Wait only when a time is being measured: waiting for the GPU costs frames.
    if (client.latency.wantsTime || settings.measure) {
      this.#completion.wait();
      this.#gate.onCost(performance.now() - beganMs);
    } else if (!inVr) this.#completion.mark();
    const endedMs = performance.now();
    client.noteDrawn(endedMs);
    this.#meter.onDrawn(cloud.endedFrame);
    stats.onDrawn(endedMs - beganMs);
    if (this.#afterDrawing.length > 0) {
      for (const act of this.#afterDrawing) act();
      this.#afterDrawing = [];
    }
  }
}
