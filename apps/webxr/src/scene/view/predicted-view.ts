/**
 * Leads the view by the operator's commands, so that it answers the hand at once: where the body and its camera are when the
 * picture is shown (docs/prediction.md). The robot's reports correct it.
 */
import { bodyYaw, opticalYaw } from '@farpoint/cloud-view';
import type { Batch, RobotClient, Telemetry } from '@farpoint/operator';
import {
  CameraMount,
  type HeadingPose,
  MotionPredictor,
  ReconciledPose,
} from '@farpoint/operator/prediction';
import { sequenceDelta32, stampUsOf } from '@farpoint/protocol';
import { signal } from '@preact/signals-core';
import type { ViewFigures } from '../../words/view-words.ts';

/**
 * A display frame takes about this long until it is seen, ms: at least as at 200 a second, at most as at 20.
 */
const LEAST_FRAME_MS = 5;
const MOST_FRAME_MS = 50;

export class PredictedView {
  /** Whether the operator wants it. */
  readonly on = signal(true);
  /** base_link, and the camera of the first sensor, when the picture is shown: REP-103 world, m and rad. */
  readonly body: HeadingPose = { x: 0, y: 0, z: 0, yaw: 0 };
  readonly camera: HeadingPose = { x: 0, y: 0, z: 0, yaw: 0 };
  readonly #client: RobotClient;
  readonly #predictor = new MotionPredictor();
  readonly #shown = new ReconciledPose();
  readonly #mount = new CameraMount();
  readonly #seen: HeadingPose = { x: 0, y: 0, z: 0, yaw: 0 };
  #frame: number | null = null;
  #atMs = 0;
  #drawnMs = 0;
  #frameMs = 1000 / 60;

  constructor(client: RobotClient, on: boolean) {
    this.#client = client;
    this.on.value = on;
    client.driver.onCommand = ({ twist }) =>
      this.#predictor.onCommand(performance.now(), twist.linear.x, twist.angular.z, twist.linear.y);
    client.on('session', () => this.#forget());
    client.on('welcome', ({ limits, body }) => this.#predictor.setLimits({ ...limits, ...body }));
    client.on('telemetry', (telemetry) => this.#onTelemetry(telemetry, performance.now()));
    client.on('cloud', (batch) => this.#onCloud(batch));
  }

  /** Whether the view stands at {@link camera} and {@link body}; otherwise it follows the clouds. */
  get places(): boolean {
    return this.on.peek() && this.#mount.known && this.#client.driver.holder === 'you';
  }

  /** Whether what is shown is a prediction, in this frame. */
  get isPrediction(): boolean {
    return this.places && this.#predictor.stateAt(this.#atMs) === 'predicted';
  }

  get figures(): ViewFigures {
    if (!this.on.peek()) return { state: 'off', aheadMs: 0 };
    const state = this.places ? this.#predictor.stateAt(this.#atMs) : 'not-driving';
    return { state, aheadMs: state === 'predicted' ? this.#predictor.aheadMs(this.#atMs) : 0 };
  }

  /** Call it for each display frame. Allocates nothing while nobody drives. @param nowMs `performance.now()` */
  update(nowMs: number): void {
    const { driver, link, stops } = this.#client;
    const elapsedMs = nowMs - this.#drawnMs;
    this.#drawnMs = nowMs;
    if (elapsedMs > LEAST_FRAME_MS && elapsedMs < MOST_FRAME_MS)
      this.#frameMs += (elapsedMs - this.#frameMs) / 8;
    this.#atMs = nowMs + this.#frameMs;
    const predictor = this.#predictor;
    predictor.driving = this.on.peek() && link.phase === 'live' && driver.holder === 'you';
    // In doubt, only what the robot reports is shown.
    predictor.stopped = link.session.estop.latched || stops.status === 'unconfirmed';
    predictor.silent = link.interrupted;
    const { asked } = driver.stream;
    if (asked === null) predictor.noWish(nowMs);
    else predictor.wish(nowMs, asked.linear.x, asked.angular.z, asked.linear.y);
    const shown = this.#shown;
    shown.follow(predictor, this.#atMs);
    const { body } = this;
    body.x = shown.x;
    body.y = shown.y;
    body.yaw = shown.yaw;
    this.#mount.place(body.x, body.y, body.z, body.yaw, this.camera);
  }

  #forget(): void {
    this.#predictor.reset();
    this.#shown.reset();
    this.#mount.reset();
    this.#frame = null;
  }

  #onTelemetry({ pose, timeMs, ageMs = 0, drive, motion }: Telemetry, nowMs: number): void {
    const { clock, welcome } = this.#client.link.session;
    const robotMs = timeMs - ageMs;
    const { x, y, z } = pose.position;
    const yaw = bodyYaw(pose.orientation);
    this.body.z = z;
    this.#mount.onBody(robotMs, x, y, z, yaw);
    this.#predictor.setClock(clock.offsetMs, clock.minRttMs);
    this.#predictor.onReport({
      robotMs,
      arrivedMs: nowMs,
      x,
      y,
      yaw,
      held: (drive !== 'driving' && drive !== 'idle') || motion?.factor === 0,
      factor: motion?.factor ?? 1,
      mostLinear: motion?.mostLinear ?? welcome?.limits.maxLinear ?? 0,
    });
  }

  /** The first packet of each frame tells where the camera was when it was captured. */
  #onCloud(batch: Batch): void {
    const { telemetry } = this.#client.link.session;
    if (telemetry === null || batch.packets === 0) return;
    const frame = batch.frameNumber(0);
    if (frame === undefined || frame === this.#frame) return;
    this.#frame = frame;
    const captureMs =
      telemetry.timeMs + sequenceDelta32(batch.captureTimeUs(0), stampUsOf(telemetry.timeMs)) / 1000;
    const of = (component: number) => batch.poseComponent(0, component);
    const seen = this.#seen;
    seen.x = of(0);
    seen.y = of(1);
    seen.z = of(2);
    seen.yaw = opticalYaw({ x: of(3), y: of(4), z: of(5), w: of(6) }, Number.NaN);
    this.#mount.onCamera(captureMs, seen);
  }
}
