/** Somebody who says that a session is its own, until the robot has judged it. Owners are whatever identifies a socket. */
export interface ResumeClaim<Robot, Operator> {
  readonly handle: string;
  readonly session: string;
  readonly robot: Robot;
  readonly operator: Operator;
}

/** The claims that wait for a robot's judgement: while one waits, the session stays with whom it belongs to. */
export class ResumeClaims<Robot extends object, Operator extends object> {
  readonly #most: number;
  readonly #makeHandle: () => string;
  readonly #claims = new Map<string, ResumeClaim<Robot, Operator>>();

  /** @param most of one operator: its older ones give way */
  constructor(most: number, makeHandle: () => string) {
    this.#most = most;
    this.#makeHandle = makeHandle;
  }

  get size(): number {
    return this.#claims.size;
  }

  /** A newer claim of the same operator on the same session replaces the older. */
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

  /** The claim that this robot judges, which then waits no more. */
  take(handle: string, session: string, robot: Robot): ResumeClaim<Robot, Operator> | null {
    const claim = this.#claims.get(handle);
    if (claim === undefined || claim.session !== session || claim.robot !== robot) return null;
    this.#claims.delete(handle);
    return claim;
  }

  /** One side is gone. */
  drop(owner: Robot | Operator): void {
    for (const [handle, claim] of this.#claims) {
      if (claim.robot === owner || claim.operator === owner) this.#claims.delete(handle);
    }
  }
}
