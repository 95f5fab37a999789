import {
  encodeJson,
  type JsonCodec,
  type MessageData,
  type ServiceToRobot,
  type SignalingErrorCode,
  serviceToRobotCodec,
} from '@farpoint/protocol';
import type { Clock } from './clock.ts';
import { MessageGuard, type MessageLimits } from './message-guard.ts';
import type { Observer } from './observer.ts';
import { type Connection, closeCodes, type Peer } from './peer.ts';

/** Replies with an error. */
export type Refuse = (
  code: SignalingErrorCode,
  message: string,
  options?: {
    session?: string;
    /** Closes the connection. */
    fatal?: boolean;
    /** Whether it counts as a fault against the peer (default true). */
    fault?: boolean;
  },
) => void;

export interface HubConnectionOptions {
  readonly clock: Clock;
  readonly observer: Observer;
  readonly limits: MessageLimits & {
    /** How long a socket may take to send its hello. */
    readonly helloTimeoutMs: number;
  };
}

export interface Handlers<Message, Entry> {
  /** Handles the first message. null if it is not a hello. */
  hello(message: Message, refuse: Refuse): Entry | 'refused' | null;
  /** @returns the type of the message if it was relayed */
  message(entry: Entry, message: Message, refuse: Refuse): string | null;
  left(entry: Entry): void;
}

/** What both kinds of sockets have in common: the hello and its deadline, refusals, faults, the end. */
export class HubConnection<Message, Entry> implements Connection {
  readonly #peer: Peer;
  readonly #role: 'robot' | 'operator';
  readonly #options: HubConnectionOptions;
  readonly #handlers: Handlers<Message, Entry>;
  readonly #guard: MessageGuard<Message>;
  readonly #cancelHello: () => void;
  #entry: Entry | null = null;
  #ended = false;

  constructor(
    peer: Peer,
    role: 'robot' | 'operator',
    codec: JsonCodec<Message>,
    options: HubConnectionOptions,
    handlers: Handlers<Message, Entry>,
  ) {
    this.#peer = peer;
    this.#role = role;
    this.#options = options;
    this.#handlers = handlers;
    this.#guard = new MessageGuard(codec, options.limits, (refusal, detail) =>
      // The guard has already counted the fault.
      this.#refuse(refusal, detail, { fault: false }),
    );
    this.#cancelHello = options.clock.after(options.limits.helloTimeoutMs, () => {
      this.#options.observer.rejected(this.#role, 'hello-overdue', '');
      this.#refuse('hello-first', `no hello within ${options.limits.helloTimeoutMs} ms`, { fatal: true });
    });
  }

  receive(data: MessageData): void {
    if (this.#ended) return;
    const begin = this.#options.clock.now();
    const message = this.#guard.read(data, begin);
    if (message !== null) this.#handle(message, begin);
    if (this.#guard.exhausted && !this.#ended) {
      this.#options.observer.rejected(this.#role, 'too-many-faults', '');
      this.#end(closeCodes.policyViolation, 'too many refused messages');
    }
  }

  closed(): void {
    this.#ended = true;
    this.#cancelHello();
    const entry = this.#entry;
    this.#entry = null;
    if (entry !== null) this.#handlers.left(entry);
  }

  shutDown(): void {
    if (this.#ended) return;
    this.#sendError('shutting-down', 'the service is restarting: reconnect in a moment');
    this.#end(closeCodes.serviceRestart, 'service restart');
  }

  #handle(message: Message, begin: number): void {
    const refuse: Refuse = (code, text, options) => this.#refuse(code, text, options);
    if (this.#entry === null) {
      const entry = this.#handlers.hello(message, refuse);
      if (entry === null) refuse('hello-first', `the first message must be ${this.#role}.hello`);
      else if (entry !== 'refused') {
        this.#cancelHello();
        this.#entry = entry;
      }
      return;
    }
    const relayed = this.#handlers.message(this.#entry, message, refuse);
    if (relayed !== null) this.#options.observer.relayed(relayed, this.#options.clock.now() - begin);
  }

  #refuse(code: SignalingErrorCode, detail: string, options: Parameters<Refuse>[2] = {}): void {
    if (this.#ended) return;
    this.#options.observer.rejected(this.#role, code, detail);
    if (options.fault !== false) this.#guard.fault();
    this.#sendError(code, detail, options.session);
    if (options.fatal) this.#end(closeCodes.policyViolation, code);
  }

  #sendError(code: SignalingErrorCode, detail: string, session?: string): void {
    const message = detail.slice(0, 1024);
    const error = { type: 'error', code, message, ...(session === undefined ? {} : { session }) } as const;
    // Operators get the same message.
    this.#peer.send(encodeJson<ServiceToRobot>(serviceToRobotCodec, error));
  }

  #end(code: number, reason: string): void {
    this.#ended = true;
    this.#cancelHello();
    this.#peer.close(code, reason);
  }
}
