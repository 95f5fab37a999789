/** One drive of `pnpm bench prediction`, in virtual time: hand, link, robot, and what the screen shows. */
import { Random } from '@farpoint/network-sim';
import type { BaseKind } from './prediction-bases.ts';
import { FIRST_TURN_S, firstTurnAt, handAt, ROUND_S } from './prediction-drive.ts';
import { FRAME_MS, PageEnd, type Picture, RobotEnd } from './prediction-ends.ts';
import { type Down, type Pose, type Up, Way } from './prediction-link.ts';
import { type Distribution, distribution, rounded } from './stats.ts';

export interface DriveSpec {
  base: BaseKind;
  /** Of the network, there and back, ms. */
  loopMs: number;
  /** Share of it on the way to the robot. */
  upShare: number;
  /** ± on each way, per packet, ms. */
  jitterMs: number;
  /** Share of packets that are lost, each way. */
  loss: number;
  /** ± of the reported poses, m and rad. */
  noiseM: number;
  rounds: number;
  seed: number;
}

export interface ViewErrors {
  errorM: Distribution;
  errorDeg: Distribution;
}

export interface DriveResult {
  spec: DriveSpec;
  /** Against the true pose when the picture is shown, from the second round on. */
  predicted: ViewErrors;
  /** In the first round, when nothing was known of the robot but what it says of itself. */
  cold: ViewErrors;
  /** In a session that begins with a turn, until the robot rests. */
  firstTurn: ViewErrors;
  /** The newest pose, followed as the page does without prediction; and as it comes. */
  without: ViewErrors;
  newest: ViewErrors;
  /** 95th percentile without prediction ÷ with. */
  ratioM: number;
  ratioDeg: number;
  /** The most that one frame corrected, whole run. */
  correctionM: number;
  correctionDeg: number;
  /** From a key to the drawing of the first frame in which the view has moved, from standing. */
  inputToViewMs: Distribution;
  model: { delayMs: number; linear: object; angular: object };
}

const COMMAND_MS = 25;
const TELEMETRY_MS = 50;
const CLOUD_MS = 1000 / 30;
const PROBE_MS = 500;
/** The robot's clock is another one. */
const ROBOT_CLOCK_MS = 7_654_321.5;

class Errors {
  readonly #m: number[] = [];
  readonly #deg: number[] = [];

  add(shown: Pose, true_: Pose): void {
    this.#m.push(Math.hypot(shown.x - true_.x, shown.y - true_.y));
    const turn = shown.yaw - true_.yaw;
    this.#deg.push((Math.abs(turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI))) * 180) / Math.PI);
  }

  get all(): ViewErrors {
    return { errorM: rounded(distribution(this.#m), 4), errorDeg: rounded(distribution(this.#deg), 3) };
  }
}

/** A timer with even intervals, in virtual time. */
class Beat {
  readonly #intervalMs: number;
  #nextMs: number;

  constructor(intervalMs: number, firstMs: number) {
    this.#intervalMs = intervalMs;
    this.#nextMs = firstMs;
  }

  /** Takes the next beat. @returns when it was due; `null` if it is not due yet */
  due(nowMs: number): number | null {
    if (nowMs < this.#nextMs) return null;
    const dueMs = this.#nextMs;
    this.#nextMs += this.#intervalMs;
    return dueMs;
  }
}

interface Drive {
  readonly hand: (seconds: number) => readonly [linear: number, angular: number];
  /** Errors before this instant are none. */
  readonly fromMs: number;
  /** Errors from here on are of a robot that is known. */
  readonly knownMs: number;
  readonly endMs: number;
}

export function driveOnce(spec: DriveSpec): DriveResult {
  const roundMs = ROUND_S * 1000;
  const rounds = { hand: handAt, fromMs: 0, knownMs: roundMs, endMs: spec.rounds * roundMs };
  const { from, to } = FIRST_TURN_S;
  const turn = {
    hand: firstTurnAt,
    fromMs: from * 1000,
    knownMs: Number.POSITIVE_INFINITY,
    endMs: to * 1000,
  };
  return { ...drive(spec, rounds), firstTurn: drive(spec, turn).cold };
}

function drive(spec: DriveSpec, plan: Drive): Omit<DriveResult, 'firstTurn'> {
  const random = new Random(spec.seed, 11);
  const robot = new RobotEnd(spec.base);
  const page = new PageEnd();
  const errors = new ViewErrorsByTime(plan);
  const { jitterMs, loss } = spec;
  const upMs = spec.loopMs * spec.upShare;
  const downLink = { delayMs: spec.loopMs - upMs, jitterMs, loss, seed: spec.seed + 1 };
  const down = new Way<Down>(downLink, (message, atMs) => page.accept(message, atMs));
  const up = new Way<Up>({ delayMs: upMs, jitterMs, loss, seed: spec.seed }, (message, atMs) => {
    if (message.kind === 'command') robot.accept(message, atMs);
    else down.send({ kind: 'answer', id: 1, sentMs: message.sentMs, robotMs: atMs + ROBOT_CLOCK_MS }, atMs);
  });
  const frames = new Beat(FRAME_MS, random.next() * FRAME_MS);
  const commands = new Beat(COMMAND_MS, random.next() * COMMAND_MS);
  const telemetry = new Beat(TELEMETRY_MS, random.next() * TELEMETRY_MS);
  const clouds = new Beat(CLOUD_MS, random.next() * CLOUD_MS);
  const probes = new Beat(PROBE_MS, 0);
  let sequence = 0;

  for (let nowMs = 0; nowMs < plan.endMs; nowMs++) {
    up.advance(nowMs);
    down.advance(nowMs);
    const wish = plan.hand(nowMs / 1000);
    page.hold(wish, nowMs);
    if (commands.due(nowMs) !== null) {
      up.send({ kind: 'command', sequence: ++sequence, wish }, nowMs);
      page.predictor.onCommand(nowMs, wish[0], wish[1]);
    }
    if (probes.due(nowMs) !== null) up.send({ kind: 'probe', sentMs: nowMs }, nowMs);
    robot.step(nowMs);
    const { pose } = robot;
    const robotMs = nowMs + ROBOT_CLOCK_MS;
    const noise = () => (random.next() * 2 - 1) * spec.noiseM;
    const measured = () => ({ x: pose.x + noise(), y: pose.y + noise(), yaw: pose.yaw + noise() });
    if (telemetry.due(nowMs) !== null) down.send({ kind: 'telemetry', robotMs, pose: measured() }, nowMs);
    if (clouds.due(nowMs) !== null) down.send({ kind: 'cloud', robotMs, pose: measured() }, nowMs);
    for (let atMs = frames.due(nowMs); atMs !== null; atMs = frames.due(nowMs)) page.draw(atMs);
    for (let shown = page.takeShown(nowMs); shown !== null; shown = page.takeShown(nowMs))
      errors.add(shown, pose, nowMs);
  }
  return resultOf(spec, page, errors);
}

/** Errors of the shown pictures, by what was known of the robot then. */
class ViewErrorsByTime {
  readonly predicted = new Errors();
  readonly cold = new Errors();
  readonly without = new Errors();
  readonly newest = new Errors();
  readonly #plan: Drive;

  constructor(plan: Drive) {
    this.#plan = plan;
  }

  /** @param pose the robot's, when the picture is shown */
  add({ view, plain, newest }: Picture, pose: Pose, nowMs: number): void {
    if (nowMs < this.#plan.fromMs) return;
    if (nowMs < this.#plan.knownMs) {
      this.cold.add(view, pose);
      return;
    }
    this.predicted.add(view, pose);
    this.without.add(plain, pose);
    this.newest.add(newest, pose);
  }
}

function resultOf(
  spec: DriveSpec,
  { predictor, correctionM, correctionRad, inputToViewMs }: PageEnd,
  errors: ViewErrorsByTime,
): Omit<DriveResult, 'firstTurn'> {
  const [predicted, without] = [errors.predicted.all, errors.without.all];
  const { delayMs, linear, angular } = predictor.model;
  return {
    spec,
    predicted,
    cold: errors.cold.all,
    without,
    newest: errors.newest.all,
    ratioM: without.errorM.p95 / predicted.errorM.p95,
    ratioDeg: without.errorDeg.p95 / predicted.errorDeg.p95,
    correctionM,
    correctionDeg: (correctionRad * 180) / Math.PI,
    inputToViewMs: rounded(distribution(inputToViewMs), 1),
    model: { delayMs, linear: { ...linear }, angular: { ...angular } },
  };
}
