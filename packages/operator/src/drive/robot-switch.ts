/**
 * From one robot to another in one action: the robot left behind gets its lease back and stands before the other is
 * connected to. Time is an argument.
 */
import type { LeaseState, RobotListing } from '@farpoint/protocol';
import type { RobotLink } from '../link/robot-link.ts';

/** The robot that the page has now. */
export interface PresentRobot {
  readonly robotId: string | null;
  /** Whether there is a session with it. */
  readonly live: boolean;
  readonly holder: LeaseState['holder'];
  /** As the robot measures, the greater of m/s and rad/s; `null` before its first telemetry. */
  readonly speed: number | null;
}

export interface RobotSwitchPort {
  /** Ends all motion asked for here and gives the lease back. */
  letGo(): void;
  connect(robotId: string): void;
}

/** Slower than this a robot counts as standing: gauges are never quite still. */
const STANDING_SPEED = 0.02;
/** A robot that does not answer is left by then; its own watchdog has stopped it long before. */
export const LONGEST_WAIT_MS = 1500;

export class RobotSwitch {
  readonly #port: RobotSwitchPort;
  #target: string | null = null;
  #deadlineMs = 0;

  constructor(port: RobotSwitchPort) {
    this.#port = port;
  }

  /** The robot that is gone to once the present one stands. */
  get target(): string | null {
    return this.#target;
  }

  choose(robotId: string, present: PresentRobot, nowMs: number): void {
    if (robotId === present.robotId) {
      this.#target = null;
      return;
    }
    // A second choice while the first one waits gets no longer wait of its own.
    if (this.#target === null) this.#deadlineMs = nowMs + LONGEST_WAIT_MS;
    this.#target = robotId;
    if (present.live) this.#port.letGo();
    this.tick(present, nowMs);
  }

  /** Stays, or leaves for good. */
  cancel(): void {
    this.#target = null;
  }

  /** Some times a second. */
  tick(present: PresentRobot, nowMs: number): void {
    const target = this.#target;
    if (target === null) return;
    if (present.live && nowMs < this.#deadlineMs) {
      if (present.holder === 'you') return;
      // What somebody else does with it is not ours to wait for.
      if (present.holder === 'nobody' && (present.speed ?? 0) > STANDING_SPEED) return;
    }
    this.#target = null;
    this.#port.connect(target);
  }
}

/** What {@link RobotSwitch} is told of the robot that the link has now. */
export function presentRobot(link: RobotLink, holder: LeaseState['holder']): PresentRobot {
  const { robotId, phase } = link;
  const { telemetry } = link.session;
  const speed =
    telemetry === null
      ? null
      : Math.max(Math.abs(telemetry.twist.linear.x), Math.abs(telemetry.twist.angular.z));
  return { robotId, live: phase === 'live', holder, speed };
}

/** The robot after this one in the list, and the first after the last; `null` where there is no other. */
export function robotAfter(robots: readonly RobotListing[], robotId: string | null): RobotListing | null {
  const index = robots.findIndex(({ id }) => id === robotId);
  const next = robots[(index + 1) % robots.length];
  return next === undefined || next.id === robotId ? null : next;
}
