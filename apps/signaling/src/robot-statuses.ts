import type { RobotStatus, StatusOfRobot } from '@farpoint/protocol';
import { TokenBucket } from '@farpoint/timing';
import type { RobotEntry } from './robot-registry.ts';
import { VersionedListing } from './versioned-listing.ts';

interface Told extends StatusOfRobot {
  /** Whose it is: another robot may take the id. */
  readonly robot: RobotEntry;
}

/**
 * Statuses that a robot may tell a second, and at once. Chosen: twice as often as our robots do (status-reporter.ts), and
 * what they tell after a reconnect besides. robot-statuses.test.ts holds it.
 */
const RATE = { perSecond: 1, burst: 5 };

const told = ({ id, status }: Told): StatusOfRobot => ({ id, status });

/** What the connected robots have said about themselves. */
export class RobotStatuses {
  readonly #statuses = new Map<string, Told>();
  /** By the robot's connection, not by what it has said: that may be forgotten. */
  readonly #rates = new WeakMap<RobotEntry, TokenBucket>();
  readonly listing = new VersionedListing<Told>(this.#statuses, {
    whole: (statuses) => ({ type: 'statuses', statuses: Array.from(statuses, told) }),
    changed: (here, gone) => ({ type: 'statuses.changed', here: here.map(told), gone }),
  });

  /** @returns false if the robot says more than it may; what it has said before stays */
  set(robot: RobotEntry, { driver, ...status }: RobotStatus, nowMs: number): boolean {
    const rate = this.#rates.get(robot) ?? new TokenBucket(RATE);
    this.#rates.set(robot, rate);
    if (!rate.take(nowMs)) return false;
    const { id } = robot;
    // Half a surrogate pair would take six characters in the list.
    const named = driver === undefined ? status : { ...status, driver: driver.toWellFormed() };
    this.#statuses.set(id, { id, status: named, robot });
    this.listing.changed(id);
    return true;
  }

  /** The robot has left, or a newer socket of it has taken over. */
  forget(robot: RobotEntry): boolean {
    if (this.#statuses.get(robot.id)?.robot !== robot) return false;
    this.#statuses.delete(robot.id);
    this.listing.changed(robot.id);
    return true;
  }
}
