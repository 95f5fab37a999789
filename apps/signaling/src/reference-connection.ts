import type { MessageData } from '@farpoint/protocol';
import type { Clock } from './clock.ts';
import type { MessageGuard } from './message-guard.ts';
import type { Observer, RejectReason } from './observer.ts';
import { type Connection, closeCodes, type Peer } from './peer.ts';

export interface ReferenceConnectionOptions {
  readonly clock: Clock;
  readonly observer: Observer;
}

/** What both kinds of sockets have in common. */
export abstract class ReferenceConnection<Message> implements Connection {
  protected readonly peer: Peer;
  readonly #role: 'reference-robot' | 'reference-client';
  readonly #options: ReferenceConnectionOptions;
  readonly #guard: MessageGuard<Message>;
  #ended = false;

  constructor(
    peer: Peer,
    role: 'reference-robot' | 'reference-client',
    guard: (refuse: (reason: RejectReason, detail: string) => void) => MessageGuard<Message>,
    options: ReferenceConnectionOptions,
  ) {
    this.peer = peer;
    this.#role = role;
    this.#options = options;
    this.#guard = guard((reason, detail) => options.observer.rejected(role, reason, detail));
  }

  receive(data: MessageData): void {
    if (this.#ended) return;
    const begin = this.#options.clock.now();
    const message = this.#guard.read(data, begin);
    if (message !== null) {
      const relayed = this.handle(message);
      if (relayed !== null) this.#options.observer.relayed(relayed, this.#options.clock.now() - begin);
    }
    if (this.#guard.exhausted) {
      this.#options.observer.rejected(this.#role, 'too-many-faults', '');
      this.end(closeCodes.policyViolation, 'too many refused messages');
    }
  }

  closed(): void {
    this.#ended = true;
    this.left();
  }

  shutDown(): void {
    this.end(closeCodes.goingAway, 'service restart');
  }

  /** @returns the type of the message if it was relayed */
  protected abstract handle(message: Message): string | null;
  protected abstract left(): void;

  protected refuse(reason: RejectReason, detail: string, fault: boolean): null {
    this.#options.observer.rejected(this.#role, reason, detail);
    if (fault) this.#guard.fault();
    return null;
  }

  protected end(code: number, reason: string): void {
    if (this.#ended) return;
    this.#ended = true;
    this.peer.close(code, reason);
  }
}
