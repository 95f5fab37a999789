import { randomBytes } from 'node:crypto';
import type {
  AfterGap,
  Command,
  DriveLimits,
  EstopReleasePolicy,
  Intervention,
  LatencyMeasured,
  Twist,
} from '@farpoint/protocol';
import {
  BlindTravel,
  type BlindTravelLimits,
  type CommandVerdict,
  DriveGuard,
  MotionSupervisor,
  type RampLimits,
  type TakePolicy,
  ViewAge,
  type ViewAgeLimits,
} from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { monotonicMs } from '../ground/clock.ts';
import { LimitedLines } from '../ground/limited-lines.ts';
import type { VelocitySink } from '../ground/velocity-sink.ts';
import { BaseOdometry } from '../sense/base/base-odometry.ts';
import { DriveStation } from './drive/drive-station.ts';
import { EstopJournal } from './drive/estop-journal.ts';
import { MotionStatus } from './drive/motion-status.ts';
import type { FixPosition } from './geofence/fix-position.ts';
import { type FenceOptions, openGeofence } from './geofence/open-geofence.ts';
import type { ObstacleStation } from './obstacles/obstacle-station.ts';
import type { ReturnConfiguration } from './return/return-announcer.ts';
import {
  type HeardOperator,
  newestHeardMs,
  type ReturnAudit,
  ReturnStation,
} from './return/return-station.ts';
import { isConfigured, type RobotStopsOptions } from './stops/open-stops.ts';

/** How the robot's motion is bounded, by its configuration only. */
export interface MotionLimits {
  ramps: RampLimits;
  /** What the driver must see; `null`: it may drive without seeing anything. */
  view: (ViewAgeLimits & BlindTravelLimits) | null;
}

export interface DriveOptions {
  id: string;
  limits: DriveLimits;
  motion: MotionLimits;
  takePolicy: TakePolicy;
  estopRelease: EstopReleasePolicy;
  afterGap: AfterGap;
  /** After a shorter gap the robot moves on if the hand has held on, ms. */
  resumeWithinMs: number;
  /** Where the robot may move; `null` for everywhere. */
  fence?: FenceOptions | null | undefined;
  /** How it drives back by itself; if undefined, never. */
  returns?: ReturnConfiguration | undefined;
  /** The stops at the robot itself. */
  stops: RobotStopsOptions;
  /** Where the robot remembers its emergency stop across restarts. */
  stateFolder: string;
}

/** What a recording takes of driving. */
export interface DriveRecording {
  /** To the wheels. */
  velocity(twist: Twist): void;
  command(session: string, command: Command, verdict: CommandVerdict): void;
  latencyMeasured(session: string, measured: LatencyMeasured): void;
}

/** What the audit log records of the robot's own doing. */
export interface DriveAudit extends ReturnAudit {
  /** @param reason why the emergency stop is latched at the start */
  startsLatched(reason: string): void;
}

export interface DriveParts {
  sink: VelocitySink;
  recording: DriveRecording | null;
  audit: DriveAudit;
  /** Simulated wheels; `null` for real ones. */
  base: object | null;
  obstacles: ObstacleStation;
  /** All operators. */
  heard: () => Iterable<HeardOperator | null | undefined>;
  /** Counts the beginning of each intervention. */
  count: (reason: Intervention) => void;
  log: Logger;
}

/** Between the operators' commands and the wheels. */
export interface Drive {
  station: DriveStation;
  /** Where the robot is: it takes what the base reports. */
  odometry: BaseOdometry;
  estop: EstopJournal;
  status: MotionStatus;
  /** Takes the robot's readings, where the fence needs a satellite receiver's; `null` if it does not. */
  fix: FixPosition | null;
  /** What drives the robot back by itself; `null`: nothing. */
  returns: ReturnStation | null;
  /** Brings obstacles and return up to date. Call this every 25 ms. */
  update: () => void;
}

/**
 * Opens what moves the robot, latched if the emergency stop outlives the last run, and the journal that preserves it for
 * the next run.
 */
export function openDrive(options: DriveOptions, parts: DriveParts): Drive {
  const { limits, motion } = options;
  const { base, sink, recording, audit, obstacles, heard, count, log } = parts;
  const odometry = new BaseOdometry(limits, base !== null);
  const movesSideways = (limits.maxLateral ?? 0) > 0;
  const fence =
    options.fence == null
      ? null
      : openGeofence(options.fence, () => odometry.believed, base !== null, movesSideways);
  const guard = openGuard(options);
  const { view, ramps } = motion;
  const blindTravel = view === null ? null : new BlindTravel(guard.view, view);
  const returns =
    options.returns === undefined
      ? null
      : new ReturnStation(options.returns, { limits, lookout: obstacles, audit, log });
  const supervisor = new MotionSupervisor(guard, {
    ramps,
    guards: [...obstacles.guards, ...(fence === null ? [] : [fence.geofence])],
    driverGuards: view === null || blindTravel === null ? [] : [new ViewAge(guard.view, view), blindTravel],
    unattended: returns?.drive ?? null,
    letGoAfter: letGoDemands(options),
  });
  const report = new InterventionReport(log, count);
  supervisor.onIntervention = (reason, nowMs) => report.begins(reason, nowMs);
  const station = new DriveStation(
    supervisor,
    (twist) => {
      sink.apply(twist, guard.estopState().latched);
      odometry.told(twist, monotonicMs());
      recording?.velocity(twist);
    },
    monotonicMs,
    () => sink.fault ?? null,
  );
  if (obstacles.topics !== null) obstacles.topics.onChange = () => station.apply();
  return {
    station,
    odometry,
    estop: openJournal(guard, options, audit, log),
    status: new MotionStatus(
      supervisor,
      blindTravel,
      () => obstacles.state(monotonicMs()),
      () => returns?.told,
    ),
    fix: fence?.fix ?? null,
    returns,
    update: () => {
      obstacles.update(odometry, guard.leaseHolder !== null || returns?.drive.isActive === true);
      if (returns?.update(odometry, newestHeardMs(heard())) === true) station.apply();
    },
  };
}

function openGuard({ limits, takePolicy, estopRelease, resumeWithinMs }: DriveOptions): DriveGuard {
  return new DriveGuard({
    limits,
    takePolicy,
    estopRelease,
    randomBytes: (bytes) => randomBytes(bytes),
    // A shorter gap does not stop the robot.
    letGoAfterMs: Math.max(limits.watchdogMs, resumeWithinMs),
  });
}

/** After a gap in what the driver sees, the hand must let go first, if that is configured. */
function letGoDemands({ afterGap, resumeWithinMs }: DriveOptions) {
  return afterGap === 'let-go'
    ? { 'view-lost': { why: 'what you saw was too old', lastsMs: resumeWithinMs } }
    : {};
}

function openJournal(
  guard: DriveGuard,
  { id, stateFolder, stops }: DriveOptions,
  audit: DriveAudit,
  log: Logger,
): EstopJournal {
  const estop = new EstopJournal(stateFolder, id, (error) =>
    log.error({ err: error }, 'the emergency stop cannot be stored: the robot will start latched'),
  );
  const { latched, heldBy } = estop.start;
  const gone = heldBy.filter((stop) => !isConfigured(stops, stop));
  if (gone.length > 0) {
    guard.latchEstop('robot');
    log.warn({ stops: gone }, 'starts latched: a stop that held the robot is configured no longer');
  }
  if (latched !== null) {
    guard.latchEstop(latched.by);
    audit.startsLatched(latched.reason);
    log.warn(
      { reason: latched.reason, detail: latched.detail },
      'starts with the emergency stop latched: whoever drives must release it, or somebody at the robot by `farpoint-robot release`',
    );
  }
  return estop;
}

/** Logs and counts what bounds the robot's motion. A driver can bring it about without end, but not fill the log. */
class InterventionReport {
  readonly #log: Logger;
  readonly #count: (reason: Intervention) => void;
  readonly #lines = new LimitedLines();

  constructor(log: Logger, count: (reason: Intervention) => void) {
    this.#log = log;
    this.#count = count;
  }

  begins(reason: Intervention, nowMs: number): void {
    this.#count(reason);
    const leftOut = this.#lines.take(nowMs);
    if (leftOut === null) return;
    this.#log.info({ reason, ...(leftOut === 0 ? {} : { unreported: leftOut }) }, 'motion is bounded');
  }
}
