/** What operators of one robot ask of each other: the drive. */
import { shortHash } from '@farpoint/audit';
import type {
  DriveRequest,
  FaultReason,
  HandoverEnd,
  NamedOperator,
  RobotSessionMessage,
} from '@farpoint/protocol';
import type { DriveGuard } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import { mayDrive } from '../../admit/access/access.ts';
import { isHere, type ListedOperator, type OperatorRoster } from '../../admit/access/operator-roster.ts';
import type { RobotCounters } from '../../ground/robot-counters.ts';
import { type DriveFacts, Handovers, type OpenHandover } from './handovers.ts';
import { peopleFaultWords } from './people-words.ts';

/** Requests and offers of one operator. Chosen: a person's second thoughts pass, and a page gets few that pop up. */
const ASKS = { perSecond: 1, burst: 5 };

export interface PeopleOptions {
  operators: ReadonlyMap<string, ListedOperator>;
  roster: OperatorRoster;
  host: {
    readonly drive: {
      readonly guard: Pick<DriveGuard, 'leaseHolder' | 'leaseState' | 'estopState' | 'handOver'>;
      apply(): void;
    };
    leaseChanged(cause: 'handed-over'): void;
    now(): number;
  };
  counters: Pick<RobotCounters, 'handovers' | 'messagesRefused'>;
  log: Logger;
}

interface Parties {
  readonly from: NamedOperator;
  readonly to: NamedOperator;
}

/** Passes requests for the drive and offers of it on to whom they concern, and tells both what becomes of them. */
export class People {
  readonly #options: PeopleOptions;
  readonly #handovers: Handovers;
  /** By the id of what is open. */
  readonly #parties = new Map<number, Parties>();
  readonly #asks = new WeakMap<ListedOperator, TokenBucket>();

  constructor(options: PeopleOptions) {
    this.#options = options;
    this.#handovers = new Handovers({
      facts: () => this.#facts(),
      mayDrive: (session) => {
        const operator = options.operators.get(session);
        return operator === undefined || !isHere(operator) ? null : mayDrive(operator.messages.access);
      },
      handOver: (from, to) => {
        const { host } = options;
        const { drive } = host;
        const moved = drive.guard.handOver(from, to, host.now());
        // Stop the wheels before telling anyone.
        drive.apply();
        if (moved) host.leaseChanged('handed-over');
        return moved;
      },
      changed: (handover, end) => this.#changed(handover, end),
    });
  }

  /** Ends what can no longer be answered. Call this every 25 ms. */
  update(): void {
    this.#handovers.endDue(this.#now);
  }

  /** A session has ended. */
  gone(session: string): void {
    this.#handovers.gone(session, this.#now);
  }

  /** Does what an operator asks, or tells it why not. */
  request(by: ListedOperator, request: DriveRequest): void {
    if (!isHere(by)) return;
    const fault = this.#judge(by, request);
    if (fault === null) return;
    by.messages.send({ type: 'fault', message: peopleFaultWords[fault] ?? fault, reason: fault });
  }

  get #now(): number {
    return this.#options.host.now();
  }

  #judge(by: ListedOperator, request: DriveRequest): FaultReason | null {
    const { id } = by.messages;
    const now = this.#now;
    switch (request.type) {
      case 'driveAsk':
        return this.#isOver(by, 'ask') ? 'rate-limited' : this.#handovers.ask(id, now);
      case 'driveOffer': {
        if (this.#isOver(by, 'offer')) return 'rate-limited';
        const { operators, roster } = this.#options;
        const to = [...operators.values()].find((each) => roster.has(each, request.to));
        return to === undefined ? 'unknown-operator' : this.#handovers.offer(id, to.messages.id, now);
      }
      case 'driveAnswer':
        return this.#handovers.answer(id, request.id, request.accept, now);
      case 'driveWithdraw':
        return this.#handovers.withdraw(id, request.id, now);
    }
  }

  #isOver(by: ListedOperator, kind: string): boolean {
    const bucket = this.#asks.get(by) ?? new TokenBucket(ASKS);
    this.#asks.set(by, bucket);
    if (bucket.take(this.#now)) return false;
    this.#options.counters.messagesRefused.add(`${kind}:rate-limited`);
    return true;
  }

  #facts(): DriveFacts {
    const { guard } = this.#options.host.drive;
    const { leaseHolder: driver } = guard;
    const lease = driver === null ? null : (guard.leaseState(driver).lease ?? null);
    const { latched, latch } = guard.estopState();
    return { driver, lease, latched, latch };
  }

  #changed(handover: OpenHandover, end: HandoverEnd | null): void {
    const { operators, roster } = this.#options;
    const [from, to] = [operators.get(handover.from), operators.get(handover.to)];
    if (end === null && from !== undefined && to !== undefined)
      this.#parties.set(handover.id, { from: roster.nameOf(from), to: roster.nameOf(to) });
    const parties = this.#parties.get(handover.id);
    if (parties === undefined) return;
    if (end !== null) {
      this.#parties.delete(handover.id);
      this.#note(handover, parties, end);
    }
    const { id, kind, endsMs } = handover;
    const leftMs = Math.max(0, Math.round(endsMs - this.#now));
    const state = end === null ? { leftMs } : { ended: end };
    for (const operator of [from, to]) {
      const yours = operator === from;
      const message: RobotSessionMessage = { type: 'handover', id, kind, ...parties, yours, ...state };
      if (operator !== undefined && isHere(operator)) operator.messages.send(message);
    }
  }

  #note({ kind, from, to }: OpenHandover, parties: Parties, end: HandoverEnd): void {
    const { counters, log } = this.#options;
    counters.handovers.add(`${kind}-${end}`);
    const who = (session: string, { name }: NamedOperator) => ({
      name,
      session: shortHash('session', session),
    });
    const facts = { kind, from: who(from, parties.from), to: who(to, parties.to), end };
    if (end === 'accepted') log.info(facts, 'the drive was handed over');
    else log.info(facts, 'the drive was not handed over');
  }
}
