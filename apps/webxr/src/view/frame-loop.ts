/** The frame loop. Decides when a picture is drawn, and how coarsely if the machine cannot keep up. */
import { type CloudView, DrawGate, DrawingGovernor, GpuCompletion, possibleFps } from '@farpoint/cloud-view';
import type { RobotClient } from '@farpoint/operator';
import type { Settings } from '../settings.ts';
import type { PageStatistics } from '../status/page-stats.ts';
import type { HeldClouds } from '../video/held-clouds.ts';
import type { VideoFeed } from '../video/video-feed.ts';
import { followScene } from './follow-scene.ts';
import type { RememberedWorld } from './remembered-world.ts';
import type { SensorClouds } from './sensor-clouds.ts';
import type { Stage } from './stage.ts';
import type { VrSession } from './vr-session.ts';

export interface FrameLoopParts {
  readonly settings: Settings;
  readonly client: RobotClient;
  readonly stage: Stage;
  readonly held: HeldClouds;
  readonly cloud: CloudView;
  readonly clouds: SensorClouds;
  readonly remembered: RememberedWorld;
  readonly videos: VideoFeed;
  readonly stats: PageStatistics;
  readonly vr: VrSession;
  /** Called before each picture in VR, because controllers send no events. */
  readHeadset(): void;
}

export class FrameLoop {
  readonly #parts: FrameLoopParts;
  readonly #completion: GpuCompletion;
  readonly #gate = new DrawGate();
  readonly #governor = new DrawingGovernor();
  #afterDrawing: (() => void)[] = [];

  constructor(parts: FrameLoopParts) {
    this.#parts = parts;
    this.#completion = new GpuCompletion(parts.stage.renderer);
    this.#completion.onCost = (costMs) => this.#gate.onCost(costMs);
  }

  start(): void {
    const { client, clouds, settings, stage } = this.#parts;
    if (settings.drawEvery !== null) {
      client.drawEvery(settings.drawEvery, settings.drawEvery);
      clouds.every = settings.drawEvery;
    }
    stage.resolution = settings.resolution;
    stage.renderer.setAnimationLoop((nowMs) => this.#frame(nowMs));
  }

  /** Calls `act` in the next display frame, after drawing and before the frame is shown. */
  afterNextFrame(act: () => void): void {
    this.#afterDrawing.push(act);
  }

  /** Call this a few times a second. Draws less if the machine cannot keep up, and follows the scene that is seen. */
  govern(nowMs: number): void {
    const { client, clouds, settings, stage, stats } = this.#parts;
    followScene(stage, clouds.all.peek());
    const { displayFramesPerSecond: drawn, offeredFramesPerSecond: offered } = stats;
    const possible = possibleFps(drawn, offered, this.#gate.costMs);
    if (document.hidden || client.phase !== 'live') this.#governor.pause();
    else if (this.#governor.update(possible, nowMs)) {
      const { scale, every } = this.#governor.step;
      stage.resolution = settings.resolution * scale;
      // A sampled cloud is not thinned further: a few thousand points are not what slows the machine down.
      if (settings.drawEvery === null) {
        client.drawEvery(every);
        clouds.every = every;
      }
    }
    if (settings.drawEvery === null) stats.drawnOneOf = clouds.drawnOneOf(this.#governor.step.every);
  }

  #frame(nowMs: number): void {
    const { client, held, cloud, clouds, remembered, videos, settings, stage, stats, vr } = this.#parts;
    // Videos are shown beside the scene: they need not wait until it can be drawn again.
    const nowOnClockMs = performance.now();
    videos.tick(nowOnClockMs);
    held.tick(videos.shownMs, nowOnClockMs);
    const inVr = vr.active.peek();
    // In VR the headset's compositor sets the pace.
    if (!inVr && this.#completion.busy) return;
    const beganMs = performance.now();
    cloud.update(beganMs);
    clouds.update(beganMs);
    if (!inVr && !this.#gate.mayDraw(cloud.endedFrame, beganMs)) {
      stats.onHeld();
      return;
    }
    this.#gate.onDraw(cloud.endedFrame, beganMs);
    if (inVr) this.#parts.readHeadset();
    stage.predicted?.update(performance.now());
    stage.prepare(cloud, nowMs);
    remembered.update(stage.viewCamera, cloud.colouring);
    stage.renderer.render(stage.scene, stage.viewCamera);
    // Wait only when a time is being measured: waiting for the GPU costs frames.
    if (client.latency.wantsTime || settings.canvas !== null) {
      this.#completion.wait();
      this.#gate.onCost(performance.now() - beganMs);
    } else if (!inVr) this.#completion.mark();
    const endedMs = performance.now();
    client.noteDrawn(endedMs);
    stats.onDrawn(endedMs - beganMs);
    if (this.#afterDrawing.length > 0) {
      for (const act of this.#afterDrawing) act();
      this.#afterDrawing = [];
    }
  }
}
