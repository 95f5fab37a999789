import { isUnintended, type PeerEnd } from '../../send/transport/peer-events.ts';
import type { OperatorSession } from './operator-session.ts';
import { type HeldPlace, judgePlace, mostOfSubject, type PlaceRules } from './place-rules.ts';

export interface OperatorPlacesOptions extends PlaceRules {
  /** How long the place of somebody who drove is kept after the connection was lost, ms. */
  readonly keepMs: number;
}

/** The parts of an operator's session that {@link OperatorPlaces} uses. */
export interface PlacedOperator {
  readonly messages: Pick<OperatorSession['messages'], 'id' | 'access'>;
  readonly peer: Pick<OperatorSession['peer'], 'close'>;
  readonly quiet: boolean;
}

/** Places of sessions that have not shown a grant yet, beside those of the operators: their roles are not known. */
export const ANTEROOM = 4;

/** The places of a robot that admits by grants. */
export class OperatorPlaces {
  readonly #rules: OperatorPlacesOptions;
  /** When each session that has a place last drove, or was admitted, ms. */
  readonly #activeMs = new Map<string, number>();
  #driver: string | null = null;
  /** Whose place is kept, and until when: of the one who drove last. */
  #kept: { readonly holder: string; readonly untilMs: number } | null = null;

  constructor(rules: OperatorPlacesOptions) {
    this.#rules = rules;
  }

  /** How many sessions may be open, with those that have shown no grant yet. */
  get mostSessions(): number {
    return this.#rules.most + ANTEROOM;
  }

  /** Notes that the driver is active. Call several times a second. @param driver who holds the lease */
  noteDriver(driver: string | null, nowMs: number): void {
    if (driver !== null && this.#activeMs.has(driver)) {
      this.#driver = driver;
      this.#activeMs.set(driver, nowMs);
    }
  }

  /**
   * An operator was admitted by its grant. Ends the session of one that gives way.
   *
   * @param driver the session that holds the lease
   * @returns why there is no place, for the operator; `null` if it has one
   */
  enter(
    operator: PlacedOperator,
    operators: ReadonlyMap<string, PlacedOperator>,
    driver: string | null,
    nowMs: number,
  ): string | null {
    const { id, access } = operator.messages;
    if (this.#activeMs.has(id)) return null;
    const holder = holderOf(operator);
    const held = [...operators.values()].flatMap((each) => this.#held(each, driver));
    const kept = this.#kept !== null && nowMs < this.#kept.untilMs ? this.#kept.holder : null;
    const verdict = judgePlace(held, kept, { holder, role: access.role ?? 'watch' }, this.#rules);
    if (verdict.kind === 'refused') {
      const own = mostOfSubject(this.#rules);
      return verdict.why === 'robot-full'
        ? 'all places are taken'
        : `the same person has ${own === 1 ? 'a session' : `${own} sessions`} with this robot already`;
    }
    this.#activeMs.set(id, nowMs);
    if (kept === holder) this.#kept = null;
    if (verdict.kind === 'instead-of') {
      const why =
        verdict.why === 'replaced'
          ? 'the same person has connected again'
          : 'somebody with a higher role needed the place';
      operators.get(verdict.session)?.peer.close('robot-full', why);
    }
    return null;
  }

  /** A session has ended. */
  ended(operator: PlacedOperator, end: PeerEnd, nowMs: number): void {
    const { id } = operator.messages;
    this.#activeMs.delete(id);
    if (id !== this.#driver) return;
    this.#driver = null;
    if (isUnintended(end)) this.#kept = { holder: holderOf(operator), untilMs: nowMs + this.#rules.keepMs };
  }

  #held(operator: PlacedOperator, driver: string | null): HeldPlace[] {
    const { id, access } = operator.messages;
    const activeMs = this.#activeMs.get(id);
    if (activeMs === undefined) return [];
    const { quiet } = operator;
    return [
      {
        session: id,
        holder: holderOf(operator),
        role: access.role ?? 'watch',
        drives: id === driver,
        quiet,
        activeMs,
      },
    ];
  }
}

/** A subject is somebody else with each issuer. */
function holderOf({ messages: { access } }: PlacedOperator): string {
  return `${access.keyId} ${access.subject}`;
}
