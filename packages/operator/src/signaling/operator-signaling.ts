/**
 * The operator's side of Farpoint's signaling, without a socket or a clock: inputs are events, outputs are calls on the
 * port. Reconnects without end.
 */

import {
  applyRobotsChanged,
  applyStatusesChanged,
  decodeJson,
  encodeJson,
  type IceServer,
  type MessageData,
  type OperatorToService,
  operatorToServiceCodec,
  PROTOCOL_VERSION,
  ProtocolError,
  type RobotListing,
  type ServiceToOperator,
  serviceToOperatorCodec,
} from '@farpoint/protocol';
import { Reconnect } from '@farpoint/timing';
import type { SignalingState } from '../link/robot-link.ts';
import { noStatusFeed, type StatusFeed } from './status-feed.ts';

/** The socket and the timer. */
export interface SignalingPort {
  /** Opens a new socket; there is at most one. */
  open(): void;
  send(text: string): void;
  close(): void;
  /** Calls {@link OperatorSignaling.onTimer} once after `ms`; a later call replaces the earlier. */
  setTimer(ms: number): void;
}

export interface SignalingEvents {
  onState(state: SignalingState): void;
  onRobots(robots: readonly RobotListing[]): void;
  /** Every message about sessions, and errors. */
  onSession(message: SessionSignal): void;
  /** The service sent something that does not conform to the protocol. */
  onFault(error: ProtocolError): void;
}

export type SessionSignal = Exclude<
  ServiceToOperator,
  { type: 'operator.welcome' | 'robots' | 'robots.changed' | 'statuses' | 'statuses.changed' }
>;

/**
 * A service that has refused the page is asked again after this time, ms. Chosen: it changes its mind only
 * when a person changes something, and thousands of pages ask.
 */
const REFUSED_RETRY_MS = 30_000;
/**
 * Time limit for answers that the service gives by itself, ms; after it the connection counts as dead.
 * Chosen: longer than TCP's first repetition of a lost packet, 1 s (RFC 6298, 2.1); the robot waits as long.
 */
const ANSWER_TIMEOUT_MS = 2000;

export class OperatorSignaling implements StatusFeed {
  readonly #port: SignalingPort;
  readonly #events: SignalingEvents;
  readonly #reconnect: Reconnect;
  readonly #name: string;
  readonly #token: string | undefined;
  #state: SignalingState = 'stopped';
  #answerDue = false;
  #iceServers: readonly IceServer[] = [];
  #signInUrl: string | null = null;
  #robots: readonly RobotListing[] = [];
  #statuses = noStatusFeed.statuses;
  /** Whether the operator looks at the list of robots. */
  #watches = false;
  /** It has been said on this connection, and nothing has come yet. An older service does not know it. */
  #watchDue = false;

  constructor(
    identity: { name: string; token?: string | undefined },
    port: SignalingPort,
    events: SignalingEvents,
    random: () => number,
  ) {
    this.#name = identity.name;
    this.#token = identity.token;
    this.#port = port;
    this.#events = events;
    this.#reconnect = new Reconnect(random);
  }

  get state(): SignalingState {
    return this.#state;
  }

  /** The ICE servers of the service's latest welcome. */
  get iceServers(): readonly IceServer[] {
    return this.#iceServers;
  }

  get statuses(): StatusFeed['statuses'] {
    return this.#statuses;
  }

  watchStatuses(on: boolean): void {
    if (on === this.#watches) return;
    this.#watches = on;
    if (!on) this.#statuses = noStatusFeed.statuses;
    this.#sendWatch();
  }

  /** Where operators sign in for a grant, from the service's latest welcome; `null` if it named no place. */
  get signInUrl(): string | null {
    return this.#signInUrl;
  }

  start(): void {
    if (this.#state === 'stopped') this.#connect();
  }

  stop(): void {
    if (this.#state === 'stopped') return;
    this.#port.close();
    this.#enter('stopped');
  }

  /** @returns whether it could be sent now */
  send(message: OperatorToService): boolean {
    if (this.#state !== 'ready') return false;
    this.#port.send(encodeJson(operatorToServiceCodec, message));
    return true;
  }

  /** Sends a request that the service answers at once. Without an answer, reconnects. @returns as {@link send} */
  ask(message: OperatorToService): boolean {
    if (!this.send(message)) return false;
    if (!this.#answerDue) this.#port.setTimer(ANSWER_TIMEOUT_MS);
    this.#answerDue = true;
    return true;
  }

  onOpen(): void {
    if (this.#state !== 'connecting') return;
    const token = this.#token === undefined ? {} : { token: this.#token };
    const hello = {
      type: 'operator.hello',
      protocol: PROTOCOL_VERSION,
      name: this.#name,
      ...token,
    } as const;
    this.#port.send(encodeJson(operatorToServiceCodec, hello));
  }

  /** The socket was closed, by either side. */
  onClose(): void {
    if (this.#state !== 'connecting' && this.#state !== 'ready') return;
    this.#enter('waiting');
    this.#port.setTimer(this.#reconnect.nextMs());
  }

  onTimer(): void {
    if (this.#state === 'connecting') {
      this.#port.close();
      this.onClose();
    } else if (this.#state === 'ready') {
      if (!this.#answerDue) return;
      this.#port.close();
      this.#connect();
    } else if (this.#state === 'waiting' || this.#state === 'refused') {
      this.#connect();
    }
  }

  /** The network came back, or the user asks: reconnects without waiting. */
  retryNow(): void {
    if (this.#state === 'waiting' || this.#state === 'refused') this.#connect();
  }

  onMessage(data: MessageData): void {
    if (this.#state !== 'connecting' && this.#state !== 'ready') return;
    this.#answerDue = false;
    let message: ServiceToOperator;
    try {
      message = decodeJson(serviceToOperatorCodec, data);
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.#events.onFault(error);
      return;
    }
    switch (message.type) {
      case 'operator.welcome':
        this.#reconnect.reset();
        this.#iceServers = message.iceServers;
        this.#signInUrl = message.signIn ?? null;
        this.#enter('ready');
        if (this.#watches) this.#sendWatch();
        return;
      case 'statuses':
      case 'statuses.changed':
        this.#onStatuses(message);
        return;
      case 'robots':
        this.#robots = message.robots;
        this.#events.onRobots(this.#robots);
        return;
      case 'robots.changed':
        this.#robots = applyRobotsChanged(this.#robots, message);
        this.#events.onRobots(this.#robots);
        return;
      case 'error':
        if (message.code === 'malformed' && this.#watchDue) {
          this.#watchDue = false;
          return;
        }
        if (message.code === 'unauthorized') {
          this.#port.close();
          this.#enter('refused');
          this.#port.setTimer(REFUSED_RETRY_MS);
        }
        this.#events.onSession(message);
        return;
      default:
        this.#events.onSession(message);
    }
  }

  #onStatuses(message: Extract<ServiceToOperator, { type: 'statuses' | 'statuses.changed' }>): void {
    this.#watchDue = false;
    // What was on its way when the operator looked away is not kept.
    if (!this.#watches) return;
    this.#statuses =
      message.type === 'statuses'
        ? new Map(message.statuses.map(({ id, status }) => [id, status]))
        : applyStatusesChanged(this.#statuses, message);
  }

  #sendWatch(): void {
    if (this.send({ type: 'statuses.watch', on: this.#watches })) this.#watchDue = this.#watches;
  }

  #connect(): void {
    this.#answerDue = false;
    this.#enter('connecting');
    this.#port.setTimer(this.#reconnect.timeoutMs);
    this.#port.open();
  }

  #enter(state: SignalingState): void {
    if (state === this.#state) return;
    this.#state = state;
    // Nobody knows any more.
    if (state !== 'ready') [this.#statuses, this.#watchDue] = [noStatusFeed.statuses, false];
    this.#events.onState(state);
  }
}
