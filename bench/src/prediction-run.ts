/** One drive of `pnpm bench prediction`, in virtual time: hand, link, robot, and what the screen shows. */
import { idealProfile, LinkModel, Random } from '@farpoint/network-sim';
import { MotionPredictor, ReconciledPose } from '@farpoint/operator/prediction';
import { ClockOffset, zeroTwist } from '@farpoint/protocol';
import { VelocityRamp } from '@farpoint/safety';
import { type BaseKind, newBase } from './prediction-bases.ts';
import { FIRST_TURN_S, firstTurnAt, handAt, ROUND_S } from './prediction-drive.ts';
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

const FRAME_MS = 1000 / 60;
const COMMAND_MS = 25;
const TELEMETRY_MS = 50;
const CLOUD_MS = 1000 / 30;
const PROBE_MS = 500;
const WHEELS_MS = 10;
const WATCHDOG_MS = 150;
/** The robot's ramps; its base may be slower. */
const RAMPS = { accelerationMps2: 1, decelerationMps2: 2, turnRadps2: 3 };
const LIMITS = { maxLinear: 1, maxAngular: 1.5, watchdogMs: WATCHDOG_MS, ...RAMPS };
/** The robot's clock is another one. */
const ROBOT_CLOCK_MS = 7_654_321.5;
/** Time constant with which the page follows poses without prediction, ms. */
const FOLLOW_MS = 90;
/** A view that has moved by this much has moved, m or rad. */
const MOVED = 2e-5;

type Pose = { x: number; y: number; yaw: number };
type Up =
  | { kind: 'command'; sequence: number; wish: readonly [number, number] }
  | { kind: 'probe'; sentMs: number };
type Down =
  | { kind: 'telemetry'; robotMs: number; pose: Pose }
  | { kind: 'cloud'; robotMs: number; pose: Pose }
  | { kind: 'answer'; id: number; sentMs: number; robotMs: number };

/** One direction of the link. */
class Way<Message> {
  readonly #link: LinkModel;
  readonly #messages = new Map<number, Message>();
  #handle = 0;

  constructor(
    delayMs: number,
    spec: DriveSpec,
    seed: number,
    deliver: (message: Message, atMs: number) => void,
  ) {
    const profile = {
      ...idealProfile,
      delayMs,
      jitterMs: spec.jitterMs,
      jitterReorders: true,
      loss: spec.loss,
    };
    const sink = {
      delivered: (handle: number, atMs: number) => {
        const message = this.#messages.get(handle);
        this.#messages.delete(handle);
        if (message !== undefined) deliver(message, atMs);
      },
      duplicated: () => {},
    };
    this.#link = new LinkModel({ profile, seed, startMs: 0, sink });
  }

  send(message: Message, nowMs: number): void {
    this.#messages.set(++this.#handle, message);
    this.#link.offer(100, nowMs, this.#handle);
  }

  advance(nowMs: number): void {
    this.#link.advance(nowMs);
  }
}

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

function drive(spec: DriveSpec, { hand, fromMs, knownMs, endMs }: Drive): Omit<DriveResult, 'firstTurn'> {
  const base = newBase(spec.base);
  const ramp = new VelocityRamp(
    { ...RAMPS, emergencyMps2: 4, emergencyTurnRadps2: 2 * RAMPS.turnRadps2 },
    WATCHDOG_MS,
  );
  const wanted = zeroTwist();
  const random = new Random(spec.seed, 11);
  const clock = new ClockOffset();
  const predictor = new MotionPredictor();
  predictor.setLimits(LIMITS);
  predictor.driving = true;
  const view = new ReconciledPose();
  const plain: Pose = { x: 0, y: 0, yaw: 0 };
  let newest: Pose = plain;
  let newestMs = 0;
  let robotCommand: readonly [number, number] = [0, 0];
  let robotSequence = 0;
  let robotHeardMs = Number.NEGATIVE_INFINITY;
  const errors = { predicted: new Errors(), cold: new Errors(), without: new Errors(), newest: new Errors() };
  const inputToView: number[] = [];
  let correctionM = 0;
  let correctionRad = 0;

  const upMs = spec.loopMs * spec.upShare;
  const down = new Way<Down>(spec.loopMs - upMs, spec, spec.seed + 1, (message, atMs) => {
    if (message.kind === 'answer') {
      clock.add({ type: 'clockAnswer', ...message }, atMs);
      predictor.setClock(clock.offsetMs, clock.minRttMs);
    } else if (message.kind === 'cloud') {
      if (message.robotMs > newestMs) newest = message.pose;
      newestMs = Math.max(newestMs, message.robotMs);
    } else
      predictor.onReport({
        robotMs: message.robotMs,
        arrivedMs: atMs,
        ...message.pose,
        held: false,
        factor: 1,
        mostLinear: LIMITS.maxLinear,
      });
  });
  const up = new Way<Up>(upMs, spec, spec.seed, (message, atMs) => {
    if (message.kind === 'probe')
      down.send({ kind: 'answer', id: 1, sentMs: message.sentMs, robotMs: atMs + ROBOT_CLOCK_MS }, atMs);
    else if (message.sequence > robotSequence) {
      robotSequence = message.sequence;
      robotCommand = message.wish;
      robotHeardMs = atMs;
    }
  });

  let sequence = 0;
  let nextFrameMs = random.next() * FRAME_MS;
  let nextCommandMs = random.next() * COMMAND_MS;
  let nextTelemetryMs = random.next() * TELEMETRY_MS;
  let nextCloudMs = random.next() * CLOUD_MS;
  let nextProbeMs = 0;
  let lastWish: readonly [number, number] = [0, 0];
  let pressedMs: number | null = null;
  const waiting: { shownMs: number; shown: Pose; plain: Pose; newest: Pose }[] = [];

  const frame = (nowMs: number) => {
    const shownMs = nowMs + FRAME_MS;
    const [linear, angular] = lastWish;
    predictor.wish(nowMs, linear, angular);
    const before = { x: view.x, y: view.y, yaw: view.yaw };
    view.follow(predictor, shownMs);
    correctionM = Math.max(correctionM, view.correctedM);
    correctionRad = Math.max(correctionRad, view.correctedRad);
    const moved = Math.hypot(view.x - before.x, view.y - before.y) + Math.abs(view.yaw - before.yaw);
    if (pressedMs !== null && moved > MOVED) {
      inputToView.push(nowMs - pressedMs);
      pressedMs = null;
    }
    const share = 1 - Math.exp(-FRAME_MS / FOLLOW_MS);
    plain.x += (newest.x - plain.x) * share;
    plain.y += (newest.y - plain.y) * share;
    const turn = newest.yaw - plain.yaw;
    plain.yaw += (turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI))) * share;
    waiting.push({ shownMs, shown: { x: view.x, y: view.y, yaw: view.yaw }, plain: { ...plain }, newest });
  };

  for (let nowMs = 0; nowMs < endMs; nowMs++) {
    up.advance(nowMs);
    down.advance(nowMs);
    const wish = hand(nowMs / 1000);
    const stood = lastWish[0] === 0 && lastWish[1] === 0;
    if (stood && (wish[0] !== 0 || wish[1] !== 0)) pressedMs = nowMs;
    lastWish = wish;
    if (nowMs >= nextCommandMs) {
      nextCommandMs += COMMAND_MS;
      up.send({ kind: 'command', sequence: ++sequence, wish }, nowMs);
      predictor.onCommand(nowMs, wish[0], wish[1]);
    }
    if (nowMs >= nextProbeMs) {
      nextProbeMs += PROBE_MS;
      up.send({ kind: 'probe', sentMs: nowMs }, nowMs);
    }
    if (nowMs % WHEELS_MS === 0) {
      const [linear, angular] = nowMs - robotHeardMs < WATCHDOG_MS ? robotCommand : [0, 0];
      wanted.linear.x = linear;
      wanted.angular.z = angular;
      const ramped = ramp.step(wanted, false, nowMs);
      base.command(ramped.linear.x, ramped.angular.z);
    }
    base.step(0.001);
    const pose = { ...base.pose };
    const robotMs = nowMs + ROBOT_CLOCK_MS;
    const noise = () => (random.next() * 2 - 1) * spec.noiseM;
    const measured = () => ({ x: pose.x + noise(), y: pose.y + noise(), yaw: pose.yaw + noise() });
    if (nowMs >= nextTelemetryMs) {
      nextTelemetryMs += TELEMETRY_MS;
      down.send({ kind: 'telemetry', robotMs, pose: measured() }, nowMs);
    }
    if (nowMs >= nextCloudMs) {
      nextCloudMs += CLOUD_MS;
      down.send({ kind: 'cloud', robotMs, pose: measured() }, nowMs);
    }
    while (nowMs >= nextFrameMs) {
      frame(nextFrameMs);
      nextFrameMs += FRAME_MS;
    }
    for (let next = waiting[0]; next !== undefined && next.shownMs <= nowMs; next = waiting[0]) {
      waiting.shift();
      if (nowMs < fromMs) continue;
      const isCold = nowMs < knownMs;
      (isCold ? errors.cold : errors.predicted).add(next.shown, pose);
      if (isCold) continue;
      errors.without.add(next.plain, pose);
      errors.newest.add(next.newest, pose);
    }
  }

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
    correctionM: correctionM,
    correctionDeg: (correctionRad * 180) / Math.PI,
    inputToViewMs: rounded(distribution(inputToView), 1),
    model: { delayMs, linear: { ...linear }, angular: { ...angular } },
  };
}
