import type { Peer } from './peer.ts';
import { VersionedListing } from './versioned-listing.ts';

/** A robot that is here now. */
export interface RobotEntry {
  readonly id: string;
  readonly name: string;
  readonly key: string;
  readonly peer: Peer;
}

export type JoinResult =
  /** `previous`: the older socket of the same robot, whose place was taken. */
  | {
      readonly ok: true;
      readonly previous: RobotEntry | null;
      /** The list has changed. */
      readonly listed: boolean;
    }
  | { readonly ok: false; readonly reason: 'robot-id-taken' | 'full' };

/** The robots that are here now, by id. */
export class RobotRegistry {
  readonly #robots = new Map<string, RobotEntry>();
  readonly #maxRobots: number;
  readonly listing = new VersionedListing(this.#robots);

  constructor(maxRobots: number) {
    this.#maxRobots = maxRobots;
  }

  get size(): number {
    return this.#robots.size;
  }

  get(id: string): RobotEntry | undefined {
    return this.#robots.get(id);
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

  /** Removes exactly this entry: not a newer one that took its place. */
  leave(entry: RobotEntry): boolean {
    if (this.#robots.get(entry.id) !== entry) return false;
    this.#robots.delete(entry.id);
    this.listing.changed(entry.id);
    return true;
  }
}
