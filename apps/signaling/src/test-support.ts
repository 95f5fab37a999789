/** For tests of the core: time, peers and observers without sockets. */
import type { Clock } from './clock.ts';
import type { Observer, RejectReason, Role } from './observer.ts';
import type { Connection, Peer } from './peer.ts';

/** Time that stands still until a test advances it. */
export class FakeClock implements Clock {
  #now = 0;
  #timers: { at: number; call: () => void }[] = [];

  now(): number {
    return this.#now;
  }

  after(ms: number, call: () => void): () => void {
    const timer = { at: this.#now + ms, call };
    this.#timers.push(timer);
    return () => {
      this.#timers = this.#timers.filter((other) => other !== timer);
    };
  }

  /** Advances time, and runs what falls due, in order. */
  advance(ms: number): void {
    const end = this.#now + ms;
    for (;;) {
      const due = this.#timers.filter((timer) => timer.at <= end).sort((a, b) => a.at - b.at)[0];
      if (due === undefined) break;
      this.#timers = this.#timers.filter((timer) => timer !== due);
      this.#now = Math.max(this.#now, due.at);
      due.call();
    }
    this.#now = end;
  }

  get pending(): number {
    return this.#timers.length;
  }
}

export type Json = Record<string, unknown>;

export class FakePeer implements Peer {
  static #next = 1;
  readonly id = FakePeer.#next++;
  readonly address = '192.0.2.1';
  backlog = 0;
  /** Messages sent to it that the test has not yet taken. */
  inbox: Json[] = [];
  /** Code and reason, if the service has closed it. */
  closed: { code: number; reason: string } | null = null;

  send(message: string | Uint8Array): void {
    if (this.closed !== null) return;
    this.inbox.push(
      JSON.parse(typeof message === 'string' ? message : new TextDecoder().decode(message)) as Json,
    );
  }

  close(code: number, reason: string): void {
    this.closed ??= { code, reason };
  }

  /** Everything since the last call. */
  take(): Json[] {
    const taken = this.inbox;
    this.inbox = [];
    return taken;
  }
}

/** The client at the other end of a {@link FakePeer}. */
export class FakeClient {
  readonly peer = new FakePeer();
  readonly connection: Connection;

  /** @param connect creates the hub's end */
  constructor(connect: (peer: FakePeer) => Connection) {
    this.connection = connect(this.peer);
  }

  send(message: unknown): void {
    this.connection.receive(JSON.stringify(message));
  }

  /** Everything since the last call. */
  take(): Json[] {
    return this.peer.take();
  }

  /** For everything since the last call: the message types, and the codes of errors. */
  types(): unknown[] {
    return this.take().map((message) => message.code ?? message.type);
  }
}

export class RecordingObserver implements Observer {
  readonly relays: string[] = [];
  readonly rejects: string[] = [];
  readonly joined: unknown[] = [];
  readonly left: unknown[] = [];
  readonly sessionEnds: string[] = [];

  robotJoined(_role: Role, id: string | number, _address: string, tookOver: boolean): void {
    this.joined.push(tookOver ? `${id} took over` : id);
  }
  robotLeft(_role: Role, id: string | number): void {
    this.left.push(id);
  }
  operatorJoined(): void {}
  operatorLeft(): void {}
  sessionOpened(): void {}
  sessionClosed(_session: string, reason: string): void {
    this.sessionEnds.push(reason);
  }
  relayed(type: string): void {
    this.relays.push(type);
  }
  rejected(role: Role, reason: RejectReason): void {
    this.rejects.push(`${role}: ${reason}`);
  }
}
