import {
  MAX_LISTED_OPERATORS,
  type NamedOperator,
  type Operators,
  type PresentOperator,
  type RobotSessionMessage,
  type Role,
  robotSessionCodec,
} from '@farpoint/protocol';
import type { Access } from './access.ts';
import { plainName } from './plain-name.ts';

/** The parts of an operator's session that {@link OperatorRoster} uses. */
export interface ListedOperator {
  readonly messages: {
    readonly id: string;
    readonly access: Access;
    /** When a message last came from it, ms on the robot's clock. */
    readonly heardMs: number;
    send(message: RobotSessionMessage): void;
  };
  readonly peer: { readonly connected: boolean };
}

/**
 * Shortest interval between two lists, ms: changes in between are told together. Chosen: people see a change
 * at once, and a page that connects again and again costs four messages a second.
 */
const INTERVAL_MS = 250;
/** An operator of whom nothing was heard for this long counts as away, ms. Chosen: as long as the lease outlives silence. */
const AWAY_MS = 3000;
const ORDER: Readonly<Record<Role, number>> = { supervise: 1, drive: 2, watch: 2 };

/** Tells every operator who is here and who drives. */
export class OperatorRoster {
  readonly #numbers = new WeakMap<ListedOperator, number>();
  #lastNumber = 0;
  #dueMs = Number.NEGATIVE_INFINITY;
  /** What was told last. */
  #told = '';
  #driver: string | null = null;
  #drivesSinceMs = 0;

  /** The number by which operators know this one, the same for as long as its session lasts. */
  numberOf(operator: ListedOperator): number {
    let number = this.#numbers.get(operator);
    if (number === undefined) {
      number = ++this.#lastNumber;
      this.#numbers.set(operator, number);
    }
    return number;
  }

  /** Whether operators know this one by the number. */
  has(operator: ListedOperator, number: number): boolean {
    return this.#numbers.get(operator) === number;
  }

  /** How others know this one. */
  nameOf(operator: ListedOperator): NamedOperator {
    const { access } = operator.messages;
    const named = { number: this.numberOf(operator), name: plainName(access.name) };
    return access.grant === null ? { ...named, claimed: true } : named;
  }

  /** Sends the list to everybody in it once it has changed. @param driver the session with the lease */
  sendDue(operators: Iterable<ListedOperator>, driver: string | null, nowMs: number): void {
    if (driver !== this.#driver) [this.#driver, this.#drivesSinceMs] = [driver, nowMs];
    if (nowMs < this.#dueMs) return;
    this.#dueMs = nowMs + INTERVAL_MS;
    const here = [...operators].filter(isHere);
    const listed = here
      .map((operator) => this.#describe(operator, driver, nowMs))
      .sort((a, b) => order(a) - order(b) || a.number - b.number);
    const now = JSON.stringify(listed);
    if (now === this.#told) return;
    this.#told = now;
    const drives = listed.some((each) => each.drives);
    const since = drives ? { drivesForS: Math.floor((nowMs - this.#drivesSinceMs) / 1000) } : {};
    for (const operator of here) {
      const number = this.numberOf(operator);
      const you = listed.filter((each) => each.number === number).map((each) => ({ ...each, you: true }));
      const others = listed.filter((each) => each.number !== number);
      operator.messages.send(longest([...you, ...others], since));
    }
  }

  #describe(operator: ListedOperator, driver: string | null, nowMs: number): PresentOperator {
    const { access, id, heardMs } = operator.messages;
    return {
      ...this.nameOf(operator),
      // Where nobody is asked for a grant, everybody may drive.
      role: access.role ?? 'drive',
      drives: id === driver,
      you: false,
      ...(nowMs - heardMs > AWAY_MS ? { away: true } : {}),
    };
  }
}

/** Whether it is connected, and admitted where the robot asks for grants. */
export function isHere({ messages, peer }: ListedOperator): boolean {
  const { grant, role } = messages.access;
  return peer.connected && (grant !== null || role === null);
}

/** The list with as many operators as fit a message. */
function longest(listed: readonly PresentOperator[], since: Pick<Operators, 'drivesForS'>): Operators {
  for (let count = Math.min(listed.length, MAX_LISTED_OPERATORS); ; count--) {
    const more = listed.length - count;
    const operators = listed.slice(0, count);
    const message: Operators = { type: 'operators', operators, ...(more > 0 ? { more } : {}), ...since };
    if (count <= 1 || Buffer.byteLength(JSON.stringify(message)) <= robotSessionCodec.maxBytes)
      return message;
  }
}

function order({ role, drives }: PresentOperator): number {
  return drives ? 0 : ORDER[role];
}
