import {
  MAX_LISTED_OPERATORS,
  type PresentOperator,
  type RobotSessionMessage,
  type Role,
} from '@farpoint/protocol';
import type { Access } from './access.ts';
import { plainName } from './plain-name.ts';

/** The parts of an operator's session that {@link OperatorRoster} uses. */
export interface ListedOperator {
  readonly messages: {
    readonly id: string;
    readonly access: Access;
    send(message: RobotSessionMessage): void;
  };
  readonly peer: { readonly connected: boolean };
}

/**
 * Shortest interval between two lists, ms: changes in between are told together. Chosen: people see a change
 * at once, and a page that connects again and again costs four messages a second.
 */
const INTERVAL_MS = 250;
const ORDER: Readonly<Record<Role, number>> = { supervise: 1, drive: 2, watch: 2 };

/** Tells every operator who is here and who drives. */
export class OperatorRoster {
  readonly #numbers = new WeakMap<ListedOperator, number>();
  #lastNumber = 0;
  #dueMs = Number.NEGATIVE_INFINITY;
  /** What was told last. */
  #told = '';

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

  /** Sends the list to everybody in it once it has changed. @param driver the session with the lease */
  sendDue(operators: Iterable<ListedOperator>, driver: string | null, nowMs: number): void {
    if (nowMs < this.#dueMs) return;
    this.#dueMs = nowMs + INTERVAL_MS;
    const here = [...operators].filter(
      ({ messages, peer }) => peer.connected && messages.access.grant !== null,
    );
    const listed = here
      .map((operator) => this.#describe(operator, driver))
      .sort((a, b) => order(a) - order(b) || a.number - b.number);
    const now = JSON.stringify(listed);
    if (now === this.#told) return;
    this.#told = now;
    for (const operator of here) {
      const number = this.numberOf(operator);
      const you = listed.filter((each) => each.number === number).map((each) => ({ ...each, you: true }));
      const others = listed.filter((each) => each.number !== number);
      const shown = [...you, ...others].slice(0, MAX_LISTED_OPERATORS);
      const more = listed.length - shown.length;
      operator.messages.send({ type: 'operators', operators: shown, ...(more > 0 ? { more } : {}) });
    }
  }

  #describe(operator: ListedOperator, driver: string | null): PresentOperator {
    const { access, id } = operator.messages;
    return {
      number: this.numberOf(operator),
      name: plainName(access.name),
      role: access.role ?? 'watch',
      drives: id === driver,
      you: false,
    };
  }
}

function order({ role, drives }: PresentOperator): number {
  return drives ? 0 : ORDER[role];
}
