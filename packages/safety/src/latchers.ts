/** Who has latched the emergency stop. */

/** More than a robot takes operators. */
const MOST_LATCHERS = 64;

/**
 * The operators who have latched the emergency stop since it was last clear. An operator is its session or, once
 * {@link identify} has told it, a subject: the same person in a session that comes later, or at the same time.
 */
export class Latchers {
  /** The subjects of the sessions that are there. */
  readonly #subjects = new Map<string, string>();
  /** In the order of their first latches. */
  readonly #latchers = new Set<string>();

  /** The session is there, and is this subject's. */
  identify(operatorId: string, subject: string): void {
    this.#subjects.set(operatorId, subject);
  }

  /** The session has ended. Without a subject, nobody can be its operator again. */
  gone(operatorId: string): void {
    if (!this.#subjects.delete(operatorId)) this.#latchers.delete(ofSession(operatorId));
  }

  add(operatorId: string): void {
    const latcher = this.#latcherOf(operatorId);
    if (this.#latchers.has(latcher)) return;
    // Subjects come and go: those who are here count first.
    if (this.#latchers.size >= MOST_LATCHERS) {
      const here = this.#here();
      const absent = [...this.#latchers].find((each) => !here.has(each));
      if (absent === undefined) return;
      this.#latchers.delete(absent);
    }
    this.#latchers.add(latcher);
  }

  has(operatorId: string): boolean {
    return this.#latchers.has(this.#latcherOf(operatorId));
  }

  /** The operator wants its own latch released. */
  withdraw(operatorId: string): void {
    this.#latchers.delete(this.#latcherOf(operatorId));
  }

  /** How many of them are there, in any session. */
  get present(): number {
    const here = this.#here();
    return [...this.#latchers].filter((each) => here.has(each)).length;
  }

  clear(): void {
    this.#latchers.clear();
  }

  #latcherOf(operatorId: string): string {
    const subject = this.#subjects.get(operatorId);
    return subject === undefined ? ofSession(operatorId) : ofSubject(subject);
  }

  #here(): ReadonlySet<string> {
    const sessions = [...this.#latchers].filter((each) => each.startsWith(SESSION));
    return new Set([...sessions, ...[...this.#subjects.values()].map(ofSubject)]);
  }
}

/** A session may have the name of a subject. */
const SESSION = 'session ';

function ofSession(operatorId: string): string {
  return `${SESSION}${operatorId}`;
}

function ofSubject(subject: string): string {
  return `subject ${subject}`;
}
