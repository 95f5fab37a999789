/** All that decides whether the robot moves: the drive, what operators ask of it, and how long silence is borne. */
import type { DriveLimits, Intervention } from '@farpoint/protocol';
import type { RobotCounters } from './ground/robot-counters.ts';
import { type Drive, type DriveOptions, type DriveParts, openDrive } from './motion/open-drive.ts';
import type { HeardOperator } from './motion/return/return-station.ts';
import type { RobotOptions } from './program/robot-configuration.ts';
import { type KeptOperator, PathKeeper, type PathKeeperOptions } from './serve/session/path-keeper.ts';
import {
  type HostedOperator,
  RobotSessionHost,
  type RobotSessionHostParts,
} from './serve/session/robot-session-host.ts';
import { silenceLimits } from './serve/session/silence.ts';

export interface DriveCoreOptions extends DriveOptions, Pick<RobotOptions, 'silenceMs' | 'leaseSilenceMs'> {
  limits: DriveLimits;
}

/** Its ends: the wheels, the operators, and those who are told. */
export interface DriveCoreParts
  extends Omit<DriveParts, 'heard' | 'count' | 'audit'>,
    Pick<RobotSessionHostParts, 'audit' | 'budgets' | 'sensors' | 'videos' | 'commandLog' | 'traces' | 'now'>,
    Pick<PathKeeperOptions, 'signaling'> {
  operators: () => ReadonlyMap<string, HostedOperator & KeptOperator>;
  /** Operators besides those. */
  alsoHeard: () => HeardOperator | null | undefined;
  counters: RobotCounters;
}

/** Links the parts between an operator's message and the wheels. Sockets, threads and sensors stay outside. */
export class DriveCore {
  readonly driving: Drive;
  readonly host: RobotSessionHost;
  readonly paths: PathKeeper;

  constructor(options: DriveCoreOptions, parts: DriveCoreParts) {
    const { operators, alsoHeard, counters, signaling, budgets, sensors, videos, commandLog, now } = parts;
    const { recording, audit, traces, log } = parts;
    const count = (reason: Intervention) => counters.interventions.add(reason);
    const heard = () => [...operators().values(), alsoHeard()];
    this.driving = openDrive(options, { ...parts, heard, count });
    const { station: drive, estop, returns } = this.driving;
    this.host = new RobotSessionHost({
      drive,
      estop,
      counters,
      recording,
      audit,
      commandLog,
      traces,
      log,
      operators,
      budgets,
      sensors,
      videos,
      now,
      driverLeft: () => returns?.drive.left(now()),
    });
    this.paths = new PathKeeper({
      operators,
      drive,
      signaling,
      counters,
      log,
      now,
      limits: silenceLimits(options.silenceMs, options.leaseSilenceMs),
      leaseChanged: () => this.host.leaseChanged('expired'),
    });
  }

  /** Acts on what the time that has passed changes. Call this every 25 ms. */
  update(): void {
    this.driving.update();
    this.host.checkLocalRelease();
    this.paths.update();
  }
}
