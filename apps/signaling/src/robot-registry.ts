import type { RobotListing } from '@farpoint/protocol';
import type { Peer } from './peer.ts';
import { type ListingWords, VersionedListing } from './versioned-listing.ts';

/** A connected robot. */
export interface RobotEntry {
  readonly id: string;
  readonly name: string;
  readonly key: string;
  readonly peer: Peer;
}

export type JoinResult =
  /** `previous`: the robot's older socket, which was replaced. */
  | {
      readonly ok: true;
      readonly previous: RobotEntry | null;
      /** Whether the list has changed. */
      readonly listed: boolean;
    }
  | { readonly ok: false; readonly reason: 'robot-id-taken' | 'full' };

const told = ({ id, name }: RobotListing): RobotListing => ({ id, name });

/** The list of robots: entries may contain more than it says. */
export const robotWords: ListingWords<RobotListing> = {
  whole: (robots) => ({ type: 'robots', robots: Array.from(robots, told) }),
  changed: (here, gone) => ({ type: 'robots.changed', here: here.map(told), gone }),
};

/** The connected robots by id. */
export class RobotRegistry {
  readonly #robots = new Map<string, RobotEntry>();
  readonly #maxRobots: number;
  readonly listing = new VersionedListing<RobotListing>(this.#robots, robotWords);

  constructor(maxRobots: number) {
    this.#maxRobots = maxRobots;
  }

  get size(): number {
    return this.#robots.size;
  }

  get(id: string): RobotEntry | undefined {
    return this.#robots.get(id);
  }

  values(): Iterable<RobotEntry> {
    return this.#robots.values();
  }

  join(entry: RobotEntry): JoinResult {
    const previous = this.#robots.get(entry.id) ?? null;
    if (previous !== null && previous.key !== entry.key) return { ok: false, reason: 'robot-id-taken' };
    if (previous === null && this.#robots.size >= this.#maxRobots) return { ok: false, reason: 'full' };
    this.#robots.set(entry.id, entry);
    const listed = previous === null || previous.name !== entry.name;
    if (listed) this.listing.changed(entry.id);
    return { ok: true, previous, listed };
  }

  /** Removes exactly this entry, but not a newer one that has replaced it. */
  leave(entry: RobotEntry): boolean {
    if (this.#robots.get(entry.id) !== entry) return false;
    this.#robots.delete(entry.id);
    this.listing.changed(entry.id);
    return true;
  }
}
