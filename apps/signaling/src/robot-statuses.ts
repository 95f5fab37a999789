import type { RobotStatus, StatusOfRobot } from '@farpoint/protocol';
import type { RobotEntry } from './robot-registry.ts';
import { VersionedListing } from './versioned-listing.ts';

interface Told extends StatusOfRobot {
  /** Whose it is: another robot may take the id. */
  readonly robot: RobotEntry;
}

const told = ({ id, status }: Told): StatusOfRobot => ({ id, status });

/** What the connected robots have said about themselves. */
export class RobotStatuses {
  readonly #statuses = new Map<string, Told>();
  readonly listing = new VersionedListing<Told>(this.#statuses, {
    whole: (statuses) => ({ type: 'statuses', statuses: Array.from(statuses, told) }),
    changed: (here, gone) => ({ type: 'statuses.changed', here: here.map(told), gone }),
  });

  set(robot: RobotEntry, { driver, ...status }: RobotStatus): void {
    const { id } = robot;
    // Half a surrogate pair would take six characters in the list.
    const named = driver === undefined ? status : { ...status, driver: driver.toWellFormed() };
    this.#statuses.set(id, { id, status: named, robot });
    this.listing.changed(id);
  }

  /** The robot has left, or a newer socket of it has taken over. */
  forget(robot: RobotEntry): boolean {
    if (this.#statuses.get(robot.id)?.robot !== robot) return false;
    this.#statuses.delete(robot.id);
    this.listing.changed(robot.id);
    return true;
  }
}
