/**
 * Switches from one robot to another in one action: the present robot's lease is released and the robot stops before
 * the page connects to the other. Time is an argument.
 */
import type { LeaseState, RobotListing } from '@farpoint/protocol';
import type { RobotLink } from '../link/robot-link.ts';

/** The robot that the page is connected to now. */
export interface PresentRobot {
  readonly robotId: string | null;
  /** Whether there is a session with it. */
  readonly live: boolean;
  readonly holder: LeaseState['holder'];
  /** As the robot measures it, the greater of m/s and rad/s; `null` before its first telemetry. */
  readonly speed: number | null;
}

export interface RobotSwitchPort {
  /** Ends all motion requested by this page and releases the lease. */
  letGo(): void;
  connect(robotId: string): void;
}

/**
 * Below this speed a robot counts as stopped, m/s, because measurements are never exactly zero. Chosen: at it
 * a robot goes 1 cm while it brakes or is left.
 */
const STANDING_SPEED = 0.02;
/** Longest wait for a robot that does not answer, ms; its own watchdog has stopped it long before. */
export const LONGEST_WAIT_MS = 1500;

export class RobotSwitch {
  readonly #port: RobotSwitchPort;
  #target: string | null = null;
  #deadlineMs = 0;

  constructor(port: RobotSwitchPort) {
    this.#port = port;
  }

  /** The robot to connect to once the present one has stopped. */
  get target(): string | null {
    return this.#target;
  }

  choose(robotId: string, present: PresentRobot, nowMs: number): void {
    if (robotId === present.robotId) {
      this.#target = null;
      return;
    }
    // A second choice during the wait does not extend it.
    if (this.#target === null) this.#deadlineMs = nowMs + LONGEST_WAIT_MS;
    this.#target = robotId;
    if (present.live) this.#port.letGo();
    this.decide(present, nowMs);
  }

  /** Drops the choice. */
  cancel(): void {
    this.#target = null;
  }

  /** Connects to the chosen robot once the present one may be left. Call several times a second. */
  decide(present: PresentRobot, nowMs: number): void {
    const target = this.#target;
    if (target === null) return;
    if (present.live && nowMs < this.#deadlineMs) {
      if (present.holder === 'you') return;
      // If somebody else drives, there is no need to wait.
      if (present.holder === 'nobody' && (present.speed ?? 0) > STANDING_SPEED) return;
    }
    this.#target = null;
    this.#port.connect(target);
  }
}

/** Describes the link's present robot for {@link RobotSwitch}. */
export function presentRobot(link: RobotLink, holder: LeaseState['holder']): PresentRobot {
  const { robotId, phase } = link;
  const { telemetry } = link.session;
  const speed =
    telemetry === null
      ? null
      : Math.max(
          Math.hypot(telemetry.twist.linear.x, telemetry.twist.linear.y),
          Math.abs(telemetry.twist.angular.z),
        );
  return { robotId, live: phase === 'live', holder, speed };
}

/** The next robot in the list, cyclically; `null` if there is no other. */
export function robotAfter(robots: readonly RobotListing[], robotId: string | null): RobotListing | null {
  const index = robots.findIndex(({ id }) => id === robotId);
  const next = robots[(index + 1) % robots.length];
  return next === undefined || next.id === robotId ? null : next;
}
