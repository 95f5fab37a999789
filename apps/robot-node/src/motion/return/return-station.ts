/** The robot's way back without operators: feeds it, and tells everybody what it does. */
import type { DriveLimits, ReturnEnd, ReturnState } from '@farpoint/protocol';
import { type Lookout, ODOMETRY_OVERSPEED, ReturnDrive, type ReturnPhase } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { ReasonCounts } from '../../ground/robot-counters.ts';
import type { BaseOdometry } from '../../sense/base/base-odometry.ts';
import { ReturnAnnouncer, type ReturnConfiguration } from './return-announcer.ts';

/** What the audit log records of it. */
export interface ReturnAudit {
  /** @param end `null`: it has begun @param metres that it has come back */
  returned(end: ReturnEnd | null, metres: number): void;
}

export interface ReturnStationParts {
  /** Of the robot. */
  limits: Pick<DriveLimits, 'maxLinear' | 'maxLateral' | 'maxAngular'>;
  lookout: Lookout;
  audit: ReturnAudit;
  log: Pick<Logger, 'info' | 'warn'>;
}

export class ReturnStation {
  /** Moves the robot, under the motion supervisor. */
  readonly drive: ReturnDrive;
  /** How often the robot has begun to drive back. */
  begun = 0;
  /** How often that ended, by reason; a return that never began counts too. */
  readonly ends = new ReasonCounts();
  readonly #configuration: ReturnConfiguration;
  readonly #parts: ReturnStationParts;
  /** `null` if it is said on no topic. */
  readonly #announcer: ReturnAnnouncer | null;
  #metres = 0;

  constructor(configuration: ReturnConfiguration, parts: ReturnStationParts) {
    const { maxLinear, maxLateral = 0, maxAngular } = parts.limits;
    this.#configuration = configuration;
    this.#parts = parts;
    const mostMps = Math.max(maxLinear, maxLateral) * ODOMETRY_OVERSPEED;
    const most = { mostMps, mostRadps: maxAngular * ODOMETRY_OVERSPEED };
    this.drive = new ReturnDrive(configuration.options, most, parts.lookout);
    const { topic } = configuration;
    this.#announcer = topic === null ? null : new ReturnAnnouncer(topic, parts.log);
    this.drive.onPhase = (phase, end) => this.#tell(phase, end);
  }

  /** What operators are told; undefined if there is nothing to say. */
  get told(): ReturnState | undefined {
    return this.drive.told;
  }

  /** How far the robot has come back by itself, in all, m. */
  get metres(): number {
    return this.#metres + (this.drive.isActive ? this.drive.metres : 0);
  }

  /**
   * Call this every 25 ms.
   *
   * @param odometry where the robot is
   * @param heardMs when any operator was last heard, robot's clock
   * @returns whether the robot must stand at once
   */
  update({ newest }: Pick<BaseOdometry, 'newest'>, heardMs: number): boolean {
    const wasActive = this.drive.isActive;
    this.drive.heard(heardMs);
    if (newest !== null) this.drive.moved(newest.pose, newest.measuredMs);
    return wasActive && !this.drive.isActive;
  }

  async close(): Promise<void> {
    await this.#announcer?.close();
  }

  #tell(phase: ReturnPhase, end: ReturnEnd | null): void {
    const { log, audit } = this.#parts;
    const { afterMs, announceMs } = this.#configuration.options;
    const metres = Math.round(this.drive.metres * 100) / 100;
    switch (phase) {
      case 'announcing':
        log.warn(
          { silentS: afterMs / 1000, inS: announceMs / 1000 },
          'no operator is heard: the robot will drive back along its track',
        );
        break;
      case 'returning':
        this.begun++;
        log.warn({ mostM: Math.round(this.drive.trackM * 100) / 100 }, 'drives back along its track');
        audit.returned(null, 0);
        break;
      case 'ended':
        this.#metres += this.drive.metres;
        this.ends.add(end ?? '');
        log.warn({ end, metres }, 'does not drive back any more');
        audit.returned(end, metres);
        break;
      default:
        break;
    }
    this.#announcer?.say(this.drive.isActive);
  }
}

export interface HeardOperator {
  /** When it was last heard, on any channel, or by RTCP or a connectivity check: robot's clock, ms. */
  readonly heardMs: number;
}

/** When any operator was last heard, robot's clock, ms; −∞ if there is none. */
export function newestHeardMs(operators: Iterable<HeardOperator | null | undefined>): number {
  let newest = Number.NEGATIVE_INFINITY;
  for (const operator of operators) newest = Math.max(newest, operator?.heardMs ?? newest);
  return newest;
}
