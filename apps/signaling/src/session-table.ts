/** A session of one operator with one robot. Owners are whatever identifies a socket. */
export interface Session<Robot, Operator> {
  readonly handle: string;
  readonly robot: Robot;
  readonly operator: Operator;
}

export interface SessionLimits {
  readonly maxSessionsPerOperator: number;
  readonly maxSessionsPerRobot: number;
}

/** The sessions being set up or running, found by handle, by robot and by operator. */
export class SessionTable<Robot extends object, Operator extends object> {
  readonly #limits: SessionLimits;
  readonly #makeHandle: () => string;
  readonly #sessions = new Map<string, Session<Robot, Operator>>();
  readonly #byOwner = new Map<object, Set<Session<Robot, Operator>>>();

  /** @param makeHandle must be unguessable */
  constructor(limits: SessionLimits, makeHandle: () => string) {
    this.#limits = limits;
    this.#makeHandle = makeHandle;
  }

  get size(): number {
    return this.#sessions.size;
  }

  /**
   * @param handle the handle of a session that its peers have and this table has forgotten
   * @returns null if either side has its maximum number of sessions
   */
  open(robot: Robot, operator: Operator, handle = this.#makeHandle()): Session<Robot, Operator> | null {
    if (!this.hasRoom(robot, operator)) return null;
    const session = { handle, robot, operator };
    this.#sessions.set(session.handle, session);
    this.#ownedBy(robot).add(session);
    this.#ownedBy(operator).add(session);
    return session;
  }

  /** @param replaced a session that ends at the same moment */
  hasRoom(robot: Robot, operator: Operator, replaced: Session<Robot, Operator> | null = null): boolean {
    const count = (owner: Robot | Operator) =>
      (this.#byOwner.get(owner)?.size ?? 0) -
      Number(replaced !== null && (replaced.robot === owner || replaced.operator === owner));
    return (
      count(operator) < this.#limits.maxSessionsPerOperator && count(robot) < this.#limits.maxSessionsPerRobot
    );
  }

  /** The session with this handle, if `owner` is one of its two sides. */
  find(handle: string, owner: Robot | Operator): Session<Robot, Operator> | null {
    const session = this.#sessions.get(handle);
    return session !== undefined && (session.robot === owner || session.operator === owner) ? session : null;
  }

  /** The session with this handle, whoever its sides are. */
  get(handle: string): Session<Robot, Operator> | null {
    return this.#sessions.get(handle) ?? null;
  }

  close(session: Session<Robot, Operator>): void {
    this.#sessions.delete(session.handle);
    this.#release(session.robot, session);
    this.#release(session.operator, session);
  }

  /** Closes and returns all sessions of one side. */
  closeAll(owner: Robot | Operator): Session<Robot, Operator>[] {
    const sessions = [...(this.#byOwner.get(owner) ?? [])];
    for (const session of sessions) this.close(session);
    return sessions;
  }

  #ownedBy(owner: object): Set<Session<Robot, Operator>> {
    let owned = this.#byOwner.get(owner);
    if (owned === undefined) {
      owned = new Set();
      this.#byOwner.set(owner, owned);
    }
    return owned;
  }

  #release(owner: object, session: Session<Robot, Operator>): void {
    const owned = this.#byOwner.get(owner);
    owned?.delete(session);
    if (owned?.size === 0) this.#byOwner.delete(owner);
  }
}
