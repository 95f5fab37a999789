/** Which robots the signaling service has listed since the page was opened. */
import type { RobotListing } from '@farpoint/protocol';

export class ListedRobots {
  #ids: Set<string> | null = null;

  /** The service has sent its list, or a change of it. */
  take(robots: readonly RobotListing[]): void {
    this.#ids ??= new Set();
    for (const { id } of robots) this.#ids.add(id);
  }

  /** Whether there has been a list, and the robot never was in it: it may not exist. */
  lacks(id: string): boolean {
    return this.#ids !== null && !this.#ids.has(id);
  }
}
