/**
 * A robot that is driven straight ahead over a link of constant latency, until something happens: what the drive guard and
 * the motion supervisor make of the commands, on the simulated base. In simulated time: the same run is the same every time.
 */
import { stampUsOf, zeroTwist } from '@farpoint/protocol';
import {
  BlindTravel,
  DriveGuard,
  MotionSupervisor,
  NO_RAMPS,
  type RampLimits,
  RESUME_WITHIN_MS,
  ViewAge,
} from '@farpoint/safety';
import { officeWorld, SimulatedBase, type WorldDescription } from '@farpoint/sim';

export const stopCauses = [
  'sight', // the driver sees what happens and presses STOP within no time
  'link', // nothing arrives any more, in either direction
  'camera', // no picture is captured any more
  'page', // the driver's page draws nothing any more; the driver holds on
] as const;
export type StopCause = (typeof stopCauses)[number];

export interface StoppingSettings {
  cause: StopCause;
  /** Speed that the driver asks for, m/s. */
  askedMps: number;
  /** From the capture of a picture until it is drawn, and from a command's reading until it arrives, in sum, ms. */
  latencyMs: number;
  /** From one picture to the next, ms. */
  intervalMs: number;
  /** Where between two pictures it happens, 0–1. */
  phase: number;
  /** Without it, neither the age of the view nor the blind travel bounds the motion. */
  bounded: boolean;
}

export interface Stop {
  /** Speed when it happened, m/s. */
  drivenMps: number;
  /** From then until the wheels are told less, ms; `null` if they stood before. */
  brakesMs: number | null;
  /** From then until the robot stands still. */
  metres: number;
  ms: number;
}

/** As the robot's defaults. */
export const RAMPS: Readonly<RampLimits> = Object.freeze({
  accelerationMps2: 1,
  decelerationMps2: 2,
  emergencyMps2: 4,
  turnRadps2: 3,
  emergencyTurnRadps2: 6,
});
export const VIEW = {
  slowMs: 250,
  brakeMs: 400,
  stallMs: 150,
  mostM: 0.5,
  decelerationMps2: 2,
  radiusM: 0.25,
};
const WATCHDOG_MS = 150;
const COMMAND_MS = 20;
/** Between two velocities for the wheels while they change, and otherwise. */
const RAMPING_MS = 10;
const REFRESH_MS = 40;
const RUN_UP_MS = 5000;
const GIVES_UP_MS = 20_000;
const START_MS = 1_000_000;
const STEP_MS = 2;

/** Nothing but floor. */
function plain(): WorldDescription {
  const { dock: _, ...office } = officeWorld();
  return { ...office, start: { x: 0, y: 0, yaw: 0 }, boxes: [], panels: [], ellipsoids: [], movers: [] };
}

/** The robot: what it is told, and what its base makes of it. */
class DrivenRobot {
  readonly guard: DriveGuard;
  readonly base: SimulatedBase;
  readonly lease: string;
  /** What the wheels are told, m/s. */
  toldMps = 0;
  readonly #motion: MotionSupervisor;
  #nextMs = 0;

  constructor(maxMps: number, bounded: boolean, ramps: RampLimits) {
    this.base = new SimulatedBase(plain(), { maxLinearSpeed: maxMps });
    this.guard = new DriveGuard({
      limits: { maxLinear: maxMps, maxAngular: 1.5, watchdogMs: WATCHDOG_MS, maxCommandsPerSecond: 100 },
      letGoAfterMs: RESUME_WITHIN_MS,
      takePolicy: 'always',
      randomBytes: (count) => new Uint8Array(count).fill(7),
    });
    const { view } = this.guard;
    this.#motion = new MotionSupervisor(this.guard, {
      ramps,
      guards: bounded ? [new ViewAge(view, VIEW), new BlindTravel(view, VIEW)] : [],
      ...(bounded
        ? { letGoAfter: { 'view-lost': { why: 'what you saw was too old', lastsMs: RESUME_WITHIN_MS } } }
        : {}),
    });
    this.guard.onOpenHand('driver');
    const granted = this.guard.requestLease('driver', false, START_MS);
    this.lease = granted.granted ? granted.lease : '';
  }

  /** @param changed whether something has arrived, so that the wheels are told at once */
  step(nowMs: number, ms: number, changed: boolean): void {
    const deadlineMs = this.guard.nextDeadlineMs;
    if (changed || nowMs >= this.#nextMs || (deadlineMs !== null && nowMs >= deadlineMs)) {
      const twist = this.#motion.velocityAt(nowMs);
      this.toldMps = twist.linear.x;
      this.base.setCommand(twist);
      this.#nextMs = nowMs + (this.#motion.ramping ? RAMPING_MS : REFRESH_MS);
    }
    this.base.step(ms / 1000);
  }
}

interface InFlight {
  arrivesMs: number;
  /** Capture time of what the page drew. */
  seenMs: number | null;
  readMs: number;
  stop: boolean;
}

/** Simulates one drive and measures the stop. */
class StoppingRun {
  readonly #settings: StoppingSettings;
  readonly #robot: DrivenRobot;
  readonly #happensMs: number;
  /** Capture times of pictures, and commands, that have not arrived. */
  #pictures: number[] = [];
  #commands: InFlight[] = [];
  #captureMs = START_MS;
  #commandMs = START_MS;
  #sequence = 0;
  /** Capture time of what the page shows. */
  #drawnMs: number | null = null;
  /** Whether the driver has pressed STOP. */
  #pressed = false;
  #before: { mps: number; metres: number; told: number } | null = null;
  #brakesMs: number | null = null;

  constructor(settings: StoppingSettings) {
    const { askedMps, intervalMs, phase, bounded } = settings;
    this.#settings = settings;
    this.#robot = new DrivenRobot(askedMps, bounded, bounded ? RAMPS : NO_RAMPS);
    this.#happensMs = START_MS + Math.ceil(RUN_UP_MS / intervalMs) * intervalMs + phase * intervalMs;
  }

  run(): Stop {
    const { cause, askedMps } = this.#settings;
    for (let nowMs = START_MS; nowMs < this.#happensMs + GIVES_UP_MS; nowMs += STEP_MS) {
      const happened = nowMs >= this.#happensMs;
      if (happened) this.#before ??= this.#state();
      const cut = cause === 'link' && happened;
      this.#capture(nowMs, cause === 'camera' && happened);
      this.#draw(nowMs, cut || (cause === 'page' && happened));
      this.#readHand(nowMs);
      const arrived = this.#arrive(nowMs, cut);
      this.#robot.step(nowMs, STEP_MS, arrived > 0);
      const stop = this.#stopAt(nowMs);
      if (stop !== null) return stop;
    }
    throw new Error(`a robot that is driven at ${askedMps} m/s does not stop after: ${cause}`);
  }

  #state() {
    const { twist, odometryDistance } = this.#robot.base.state;
    return { mps: twist.linear.x, metres: odometryDistance, told: this.#robot.toldMps };
  }

  #capture(nowMs: number, fails: boolean): void {
    for (; this.#captureMs <= nowMs; this.#captureMs += this.#settings.intervalMs) {
      if (fails) continue;
      this.#pictures.push(this.#captureMs);
      this.#robot.guard.view.sent(nowMs);
    }
  }

  #draw(nowMs: number, fails: boolean): void {
    const halfMs = this.#settings.latencyMs / 2;
    const drawn = fails ? [] : this.#pictures.filter((at) => at + halfMs <= nowMs);
    this.#drawnMs = drawn.at(-1) ?? this.#drawnMs;
    this.#pictures = this.#pictures.filter((at) => at + halfMs > nowMs);
  }

  /** Sends a command for each time at which the page reads the driver's hand. */
  #readHand(nowMs: number): void {
    const { cause, latencyMs } = this.#settings;
    for (; this.#commandMs <= nowMs; this.#commandMs += COMMAND_MS) {
      const [readMs, seenMs] = [this.#commandMs, this.#drawnMs];
      const stop = cause === 'sight' && !this.#pressed && seenMs !== null && seenMs >= this.#happensMs;
      this.#pressed ||= stop;
      this.#commands.push({ arrivesMs: readMs + latencyMs / 2, readMs, seenMs, stop });
    }
  }

  /** @returns how many commands have arrived at the robot */
  #arrive(nowMs: number, cut: boolean): number {
    const arrived = cut ? [] : this.#commands.filter(({ arrivesMs }) => arrivesMs <= nowMs);
    this.#commands = this.#commands.filter(({ arrivesMs }) => arrivesMs > nowMs);
    for (const command of arrived) this.#accept(command, nowMs);
    return arrived.length;
  }

  #accept({ seenMs, readMs, stop }: InFlight, nowMs: number): void {
    const { guard, lease } = this.#robot;
    if (stop) guard.latchEstop('operator', 'driver');
    const twist = { ...zeroTwist(), linear: { x: this.#settings.askedMps, y: 0, z: 0 } };
    const seen = seenMs === null ? {} : { seenUs: stampUsOf(seenMs) };
    if (seenMs !== null) guard.sentViews.sent('driver', seenMs);
    const sequence = this.#sequence++;
    guard.onCommand(
      'driver',
      { type: 'command', sequence, timeMs: readMs, lease, deadMan: true, twist, ...seen },
      nowMs,
    );
  }

  /** @returns `null` while the robot moves, and before anything has happened */
  #stopAt(nowMs: number): Stop | null {
    const before = this.#before;
    if (before === null) return null;
    const { mps, metres, told } = this.#state();
    if (told < before.told - 1e-9) this.#brakesMs ??= nowMs - this.#happensMs;
    if (mps !== 0 || told !== 0 || (this.#settings.cause === 'sight' && !this.#pressed)) return null;
    return {
      drivenMps: before.mps,
      brakesMs: this.#brakesMs,
      metres: metres - before.metres,
      ms: nowMs - this.#happensMs,
    };
  }
}

/** The worst of several instants between two pictures. */
export function worstStop(settings: Omit<StoppingSettings, 'phase'>, phases = 8): Stop {
  const stops = Array.from({ length: phases }, (_, i) =>
    new StoppingRun({ ...settings, phase: (i + 0.06) / phases }).run(),
  );
  const most = (of: (stop: Stop) => number) => Math.max(...stops.map(of));
  const braking = stops.flatMap(({ brakesMs }) => (brakesMs === null ? [] : [brakesMs]));
  return {
    drivenMps: most(({ drivenMps }) => drivenMps),
    brakesMs: braking.length === 0 ? null : Math.max(...braking),
    metres: most(({ metres }) => metres),
    ms: most(({ ms }) => ms),
  };
}

/**
 * From a command for motion, from standing still, until the simulated base has half the speed; the base ramps by itself.
 *
 * @returns ms with the supervisor's ramps, and without
 */
export function feltMs(askedMps: number): { ramped: number; plain: number } {
  return { ramped: rise(askedMps, RAMPS), plain: rise(askedMps, NO_RAMPS) };
}

function rise(askedMps: number, ramps: RampLimits): number {
  const robot = new DrivenRobot(askedMps, false, ramps);
  const twist = { ...zeroTwist(), linear: { x: askedMps, y: 0, z: 0 } };
  const { lease } = robot;
  for (let ms = 0; ms < GIVES_UP_MS; ms += 2) {
    const nowMs = START_MS + ms;
    const commanded = ms % COMMAND_MS === 0;
    if (commanded) {
      robot.guard.onCommand(
        'driver',
        { type: 'command', sequence: ms / COMMAND_MS, timeMs: nowMs, lease, deadMan: true, twist },
        nowMs,
      );
    }
    robot.step(nowMs, 2, commanded);
    if (robot.base.state.twist.linear.x >= askedMps / 2) return ms + 2;
  }
  throw new Error(`the base does not reach half of ${askedMps} m/s`);
}
