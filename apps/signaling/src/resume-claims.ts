/**
 * An operator's claim that a session belongs to it, until the robot has judged it. Owners are whatever identifies a
 * socket.
 */
export interface ResumeClaim<Robot, Operator> {
  readonly handle: string;
  readonly session: string;
  readonly robot: Robot;
  readonly operator: Operator;
}

/** Claims waiting for a robot's judgement. Meanwhile, the session stays with its present owner. */
export class ResumeClaims<Robot extends object, Operator extends object> {
  readonly #most: number;
  readonly #makeHandle: () => string;
  readonly #claims = new Map<string, ResumeClaim<Robot, Operator>>();

  /** @param most maximum number of claims per operator; its oldest are dropped */
  constructor(most: number, makeHandle: () => string) {
    this.#most = most;
    this.#makeHandle = makeHandle;
  }

  get size(): number {
    return this.#claims.size;
  }

  /** A newer claim by the same operator on the same session replaces the older one. */
  add(session: string, robot: Robot, operator: Operator): ResumeClaim<Robot, Operator> {
    const own = [...this.#claims.values()].filter((claim) => claim.operator === operator);
    const [oldest] = own;
    const older = own.find((claim) => claim.session === session);
    const gone = older ?? (own.length >= this.#most ? oldest : undefined);
    if (gone !== undefined) this.#claims.delete(gone.handle);
    const claim = { handle: this.#makeHandle(), session, robot, operator };
    this.#claims.set(claim.handle, claim);
    return claim;
  }

  /** Removes and returns the claim that this robot has judged. */
  take(handle: string, session: string, robot: Robot): ResumeClaim<Robot, Operator> | null {
    const claim = this.#claims.get(handle);
    if (claim === undefined || claim.session !== session || claim.robot !== robot) return null;
    this.#claims.delete(handle);
    return claim;
  }

  /** Drops all claims of a side that has left. */
  drop(owner: Robot | Operator): void {
    for (const [handle, claim] of this.#claims) {
      if (claim.robot === owner || claim.operator === owner) this.#claims.delete(handle);
    }
  }
}
