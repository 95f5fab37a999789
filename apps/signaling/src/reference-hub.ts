import {
  encodeJson,
  encodeJsonBytes,
  type ReferenceClientToService,
  type ReferenceRobot,
  type ReferenceRobotToService,
  type ReferenceServiceToClient,
  type ReferenceServiceToRobot,
  referenceClientToServiceCodec,
  referenceRobotToServiceCodec,
  referenceServiceToClientCodec,
  referenceServiceToRobotCodec,
} from '@farpoint/protocol';
import { MessageGuard, type MessageLimits } from './message-guard.ts';
import { type Connection, closeCodes, type Peer } from './peer.ts';
import { ReferenceConnection, type ReferenceConnectionOptions } from './reference-connection.ts';
import { RelayBudgets, type RelayLimits } from './relay-budget.ts';

export interface ReferenceHubOptions extends ReferenceConnectionOptions {
  readonly limits: MessageLimits &
    RelayLimits & {
      readonly maxRobots: number;
      /** Number of candidates buffered for late clients in each direction; the oldest are dropped first. */
      readonly maxCandidatesPerRobot: number;
    };
}

interface Entry {
  readonly peer: Peer;
  readonly record: ReferenceRobot;
  /** The record as JSON, until it changes. Lists are assembled from these. */
  json: string | null;
}

/**
 * The reference system's signaling for its own robots and bridges (see `@farpoint/protocol`, signaling/reference.ts).
 * Every client sees every robot and may answer it. A robot's socket speaks only for its own robot. The protocol has
 * no error messages: refused messages are counted and dropped, and a socket that sends nothing else is closed.
 */
export class ReferenceHub {
  readonly #options: ReferenceHubOptions;
  readonly #robots = new Map<number, Entry>();
  readonly #clients = new Set<Peer>();
  #nextId = 0;
  #listing: Uint8Array | null = null;
  readonly #budgets: RelayBudgets;

  constructor(options: ReferenceHubOptions) {
    this.#options = options;
    this.#budgets = new RelayBudgets(options.limits);
  }

  get counts(): { robots: number; clients: number } {
    return { robots: this.#robots.size, clients: this.#clients.size };
  }

  /** Handles a socket on the port for robots. */
  robot(peer: Peer): Connection {
    return new RobotConnection(peer, this, this.#options);
  }

  /** Handles a socket on the port for clients, which is told of changes from now on. */
  client(peer: Peer): Connection {
    this.#clients.add(peer);
    return new ClientConnection(peer, this, this.#options);
  }

  /** @returns the new robot's id, or null if there is no room */
  register(peer: Peer, name: string, sdpOffer: string | null): number | null {
    if (this.#robots.size >= this.#options.limits.maxRobots) return null;
    const id = this.#nextId++;
    const record = { id, name, sdpOffer, sdpAnswer: null, robotCandidates: [], clientCandidates: [] };
    this.#robots.set(id, { peer, record, json: null });
    this.#listing = null;
    toRobot(peer, { type: 'registered', robotId: id });
    this.#toClients({ type: 'register', robot: record });
    this.#options.observer.robotJoined('reference-robot', id, peer.address, false);
    return id;
  }

  /** @param explicit the robot deregistered itself, rather than disappearing */
  deregister(id: number, explicit: boolean): void {
    if (!this.#robots.delete(id)) return;
    this.#listing = null;
    if (explicit) this.#toClients({ type: 'deregister', robotId: id });
    this.#toClients({ type: 'deregistered', robotId: id });
    this.#options.observer.robotLeft('reference-robot', id);
  }

  offer(id: number, sdpOffer: string): void {
    const record = this.#change(id);
    if (record === null) return;
    record.sdpOffer = sdpOffer;
    record.sdpAnswer = null; // the answer was to the previous offer
    this.#toClients({ type: 'offer', robotId: id, sdpOffer });
  }

  robotCandidate(id: number, candidate: string): void {
    const record = this.#change(id);
    if (record === null) return;
    this.#buffer(record.robotCandidates, candidate);
    this.#toClients({ type: 'candidate', robotId: id, candidate });
  }

  /** @returns why nothing has changed, or `null` */
  answer(from: Peer, id: number, sdpAnswer: string): 'unknown-robot' | 'no-offer' | 'rate-limited' | null {
    if (this.#robots.get(id)?.record.sdpOffer === null) return 'no-offer';
    if (!this.#mayRelay(from, id, sdpAnswer.length)) return 'rate-limited';
    const record = this.#change(id);
    if (record === null) return 'unknown-robot';
    record.sdpAnswer = sdpAnswer;
    toRobot(this.#robots.get(id)!.peer, { type: 'sdpAnswer', sdpAnswer });
    return null;
  }

  /** @returns why nothing has changed, or `null` */
  clientCandidate(from: Peer, id: number, candidate: string): 'unknown-robot' | 'rate-limited' | null {
    if (!this.#mayRelay(from, id, candidate.length)) return 'rate-limited';
    const record = this.#change(id);
    if (record === null) return 'unknown-robot';
    this.#buffer(record.clientCandidates, candidate);
    toRobot(this.#robots.get(id)!.peer, { type: 'candidate', candidate });
    return null;
  }

  #mayRelay(from: Peer, id: number, bytes: number): boolean {
    const robot = this.#robots.get(id);
    if (robot === undefined) return true;
    return this.#budgets.refusal(from, robot.peer, bytes, this.#options.clock.now()) === null;
  }

  /** The message `robots`, encoded once per change. */
  listing(): Uint8Array {
    if (this.#listing === null) {
      const robots: string[] = [];
      for (const entry of this.#robots.values()) {
        entry.json ??= JSON.stringify(entry.record);
        robots.push(entry.json);
      }
      this.#listing = Buffer.from(`{"type":"robots","robots":[${robots.join(',')}]}`);
    }
    return this.#listing;
  }

  clientLeft(peer: Peer): void {
    this.#clients.delete(peer);
  }

  #change(id: number): ReferenceRobot | null {
    const entry = this.#robots.get(id);
    if (entry === undefined) return null;
    entry.json = null;
    this.#listing = null;
    return entry.record;
  }

  #buffer(candidates: string[], candidate: string): void {
    candidates.push(candidate);
    if (candidates.length > this.#options.limits.maxCandidatesPerRobot) candidates.shift();
  }

  #toClients(message: ReferenceServiceToClient): void {
    if (this.#clients.size === 0) return;
    const bytes = encodeJsonBytes(referenceServiceToClientCodec, message);
    for (const client of this.#clients) client.send(bytes);
  }
}

class RobotConnection extends ReferenceConnection<ReferenceRobotToService> {
  readonly #hub: ReferenceHub;
  /** The only robot that this socket may speak for. */
  #robotId: number | null = null;

  constructor(peer: Peer, hub: ReferenceHub, options: ReferenceHubOptions) {
    super(
      peer,
      'reference-robot',
      (refuse) =>
        new MessageGuard(referenceRobotToServiceCodec, options.limits, refuse, {
          binary: true,
        }),
      options,
    );
    this.#hub = hub;
  }

  protected handle(message: ReferenceRobotToService): string | null {
    if (message.type === 'register') {
      if (this.#robotId !== null) this.#hub.deregister(this.#robotId, false); // it registers again
      this.#robotId = this.#hub.register(this.peer, message.name, message.sdpOffer ?? null);
      if (this.#robotId === null) {
        this.refuse('full', 'no room for another robot', false);
        this.end(closeCodes.tryAgainLater, 'no room for another robot');
      }
      return null;
    }
    if (message.robotId !== this.#robotId) {
      return this.refuse('not-yours', `${message.type} for robot ${message.robotId}`, true);
    }
    switch (message.type) {
      case 'offer':
        this.#hub.offer(message.robotId, message.sdpOffer);
        return 'reference.offer';
      case 'candidate':
        this.#hub.robotCandidate(message.robotId, message.candidate);
        return 'reference.candidate';
      case 'deregister':
        this.#hub.deregister(message.robotId, true);
        this.#robotId = null;
        return null;
    }
  }

  protected left(): void {
    if (this.#robotId !== null) this.#hub.deregister(this.#robotId, false);
    this.#robotId = null;
  }
}

class ClientConnection extends ReferenceConnection<ReferenceClientToService> {
  readonly #hub: ReferenceHub;

  constructor(peer: Peer, hub: ReferenceHub, options: ReferenceHubOptions) {
    super(
      peer,
      'reference-client',
      (refuse) =>
        new MessageGuard(referenceClientToServiceCodec, options.limits, refuse, {
          binary: true,
        }),
      options,
    );
    this.#hub = hub;
  }

  protected handle(message: ReferenceClientToService): string | null {
    switch (message.type) {
      case 'getRobots':
        this.peer.send(this.#hub.listing());
        return null;
      case 'answer': {
        const refusal = this.#hub.answer(this.peer, message.robotId, message.sdpAnswer);
        return refusal === null ? 'reference.answer' : this.#refuse(refusal, message);
      }
      case 'candidate': {
        const refusal = this.#hub.clientCandidate(this.peer, message.robotId, message.candidate);
        return refusal === null ? 'reference.candidate' : this.#refuse(refusal, message);
      }
    }
  }

  /** Not a fault: the robot may have left a moment ago. */
  #refuse(
    reason: 'unknown-robot' | 'no-offer' | 'rate-limited',
    { type, robotId }: { type: string; robotId: number },
  ): null {
    return this.refuse(reason, `${type} for robot ${robotId}`, false);
  }

  protected left(): void {
    this.#hub.clientLeft(this.peer);
  }
}

function toRobot(peer: Peer, message: ReferenceServiceToRobot): void {
  peer.send(encodeJson(referenceServiceToRobotCodec, message));
}
