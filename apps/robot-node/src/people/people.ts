import { shortHash } from '@farpoint/audit';
import type {
  FaultReason,
  HandoverEnd,
  NamedOperator,
  PeopleRequest,
  RobotSessionMessage,
} from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import { mayDrive } from '../access/access.ts';
import { isHere, type ListedOperator, type OperatorRoster } from '../access/operator-roster.ts';
import type { SessionHost } from '../session/operator-messages.ts';
import type { RobotCounters } from '../telemetry/robot-counters.ts';
import { ChatRoom, chatLineFor } from './chat-room.ts';
import { type DriveFacts, Handovers, type OpenHandover } from './handovers.ts';
import { peopleFaultWords } from './people-words.ts';

const ASKS = { perSecond: 1, burst: 5 };
const LINES = { perSecond: 1, burst: 5 };

export interface PeopleOptions {
  operators: ReadonlyMap<string, ListedOperator>;
  roster: OperatorRoster;
  host: {
    readonly drive: {
      readonly guard: Pick<
        SessionHost['drive']['guard'],
        'leaseHolder' | 'leaseState' | 'estopState' | 'handOver'
      >;
      apply(): void;
    };
    leaseChanged(cause: 'handed-over'): void;
    now(): number;
  };
  counters: Pick<RobotCounters, 'handovers' | 'chatLines' | 'messagesRefused'>;
  log: Logger;
}

interface Parties {
  readonly from: NamedOperator;
  readonly to: NamedOperator;
}

/** What operators of one robot ask of each other: the drive, and to read a line. */
export class People {
  readonly #options: PeopleOptions;
  readonly #handovers: Handovers;
  readonly #room = new ChatRoom();
  /** By the id of what is open. */
  readonly #parties = new Map<number, Parties>();
  readonly #asks = new WeakMap<ListedOperator, TokenBucket>();
  readonly #says = new WeakMap<ListedOperator, TokenBucket>();

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

  /** Call several times a second. */
  tick(): void {
    this.#handovers.look(this.#now);
  }

  /** A session begins: it reads what was said before. */
  joined({ messages }: ListedOperator): void {
    for (const line of this.#room.lines) messages.send(chatLineFor(messages.id, line, this.#now));
  }

  /** A session has ended. */
  gone(session: string): void {
    this.#handovers.gone(session, this.#now);
  }

  take(by: ListedOperator, request: PeopleRequest): void {
    if (!isHere(by)) return;
    if (request.type === 'chat') {
      this.#say(by, request.text);
      return;
    }
    const fault = this.#judge(by, request);
    if (fault !== null)
      by.messages.send({ type: 'fault', message: peopleFaultWords[fault] ?? fault, reason: fault });
  }

  get #now(): number {
    return this.#options.host.now();
  }

  #judge(by: ListedOperator, request: Exclude<PeopleRequest, { type: 'chat' }>): FaultReason | null {
    const { id } = by.messages;
    const now = this.#now;
    switch (request.type) {
      case 'driveAsk':
        return this.#isOver(this.#asks, ASKS, by, 'ask') ? 'rate-limited' : this.#handovers.ask(id, now);
      case 'driveOffer': {
        if (this.#isOver(this.#asks, ASKS, by, 'offer')) return 'rate-limited';
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

  #say(by: ListedOperator, text: string): void {
    const { operators, roster, counters } = this.#options;
    const { messages } = by;
    if (this.#isOver(this.#says, LINES, by, 'chat')) {
      const message = 'lines are passed on one a second: this one was not';
      messages.send({ type: 'fault', message, reason: 'rate-limited' });
      return;
    }
    counters.chatLines++;
    const line = this.#room.say(messages.id, roster.nameOf(by), text, this.#now);
    for (const each of operators.values())
      if (isHere(each)) each.messages.send(chatLineFor(each.messages.id, line, this.#now));
  }

  #isOver(
    buckets: WeakMap<ListedOperator, TokenBucket>,
    rate: typeof ASKS,
    by: ListedOperator,
    kind: string,
  ): boolean {
    const bucket = buckets.get(by) ?? new TokenBucket(rate);
    buckets.set(by, bucket);
    if (bucket.take(this.#now)) return false;
    this.#options.counters.messagesRefused.add(`${kind}:rate-limited`);
    return true;
  }

  #facts(): DriveFacts {
    const { guard } = this.#options.host.drive;
    const { leaseHolder: driver } = guard;
    const { latched, latch } = guard.estopState();
    return {
      driver,
      lease: driver === null ? null : (guard.leaseState(driver).lease ?? null),
      latched,
      latch,
    };
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
      const message: RobotSessionMessage = {
        ...{ type: 'handover', id, kind, ...parties, yours: operator === from },
        ...state,
      };
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
