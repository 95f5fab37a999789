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

export interface ReferenceHubOptions extends ReferenceConnectionOptions {
  readonly limits: MessageLimits & {
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

  constructor(options: ReferenceHubOptions) {
    this.#options = options;
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
  answer(id: number, sdpAnswer: string): 'unknown-robot' | 'no-offer' | null {
    if (this.#robots.get(id)?.record.sdpOffer === null) return 'no-offer';
    const record = this.#change(id);
    if (record === null) return 'unknown-robot';
    record.sdpAnswer = sdpAnswer;
    toRobot(this.#robots.get(id)!.peer, { type: 'sdpAnswer', sdpAnswer });
    return null;
  }

  /** @returns false if there is no such robot */
  clientCandidate(id: number, candidate: string): boolean {
    const record = this.#change(id);
    if (record === null) return false;
    this.#buffer(record.clientCandidates, candidate);
    toRobot(this.#robots.get(id)!.peer, { type: 'candidate', candidate });
    return true;
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
        const refusal = this.#hub.answer(message.robotId, message.sdpAnswer);
        return refusal === null ? 'reference.answer' : this.#refuse(refusal, message);
      }
      case 'candidate':
        return this.#hub.clientCandidate(message.robotId, message.candidate)
          ? 'reference.candidate'
          : this.#refuse('unknown-robot', message);
    }
  }

  /** Not a fault: the robot may have left a moment ago. */
  #refuse(reason: 'unknown-robot' | 'no-offer', { type, robotId }: { type: string; robotId: number }): null {
    return this.refuse(reason, `${type} for robot ${robotId}`, false);
  }

  protected left(): void {
    this.#hub.clientLeft(this.peer);
  }
}

function toRobot(peer: Peer, message: ReferenceServiceToRobot): void {
  peer.send(encodeJson(referenceServiceToRobotCodec, message));
}
