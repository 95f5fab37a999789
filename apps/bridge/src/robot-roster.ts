/**
 * The robots that the bridge knows: those listed by signaling, a connection to each, and which of them is shown. A
 * robot whose registration ends while its points still arrive is kept until they stop, or until the robot registers
 * again under the same name. Signaling only introduces peers; the stream does not depend on it.
 */
import { createHash } from 'node:crypto';
import type { ReferenceClientToService, ReferenceServiceToClient } from '@farpoint/protocol';
import type { AssembledFrame } from './frame-assembler.ts';
import { RobotConnection, type RobotConnectionOptions } from './robot-connection.ts';
import { RobotSelection } from './robot-selection.ts';

export interface RosterOptions extends RobotConnectionOptions {
  maxRobots: number;
}

export interface RosterEvents {
  /** Sends a message to the signaling service. */
  send(message: ReferenceClientToService): void;
  onFrame(frame: AssembledFrame, lastPacketMs: number): void;
  onRobotsChanged(): void;
  onSelected(robotId: number | null): void;
  onRobotFailed(robotId: number, detail: string): void;
}

interface Robot {
  readonly name: string;
  offer: string;
  readonly connection: RobotConnection;
  /** Whether its registration has ended. */
  orphan: boolean;
}

/** An orphan without points for this long is removed, ms. */
const ORPHAN_SILENCE_MS = 3000;
/** Ids for orphans whose own id now belongs to another robot. The service counts up from 0. */
const FIRST_ORPHAN_ID = 0x8000_0000;
/** Number of answered offers to remember. */
const MAX_SPENT_OFFERS = 1000;

export class RobotRoster {
  failed = 0;
  refused = 0;
  readonly #options: RosterOptions;
  readonly #events: RosterEvents;
  readonly #robots = new Map<number, Robot>();
  readonly #selection: RobotSelection;
  #nextOrphanId = FIRST_ORPHAN_ID;
  /**
   * Offers that have been answered and must not be answered again. The reference signaling keeps listing
   * registrations that have ended, and its robot would take a second answer for one to its newer offer.
   */
  readonly #spent = new Set<string>();

  constructor(options: RosterOptions, events: RosterEvents) {
    this.#options = options;
    this.#events = events;
    this.#selection = new RobotSelection({
      onSwitch: (id, word) => {
        const connection = this.#robots.get(id)?.connection;
        if (connection === undefined) return;
        connection.shown = word === 'start';
        if (word === 'stop') connection.assembler.clear();
        connection.tell(word);
      },
      onSelected: (id) => events.onSelected(id),
    });
  }

  get size(): number {
    return this.#robots.size;
  }

  get robots(): { id: number; name: string }[] {
    return this.#selection.robots;
  }

  get selected(): number | null {
    return this.#selection.selected;
  }

  /** The connection to the robot that is shown. */
  get shown(): RobotConnection | null {
    return this.#robots.get(this.#selection.selected ?? -1)?.connection ?? null;
  }

  /** Sum of a value over the connections of all robots. */
  sum(read: (connection: RobotConnection) => number): number {
    let total = 0;
    for (const { connection } of this.#robots.values()) total += read(connection);
    return total;
  }

  /** @returns false if there is no such robot */
  select(robotId: number): boolean {
    return this.#selection.select(robotId);
  }

  onSignaling(message: ReferenceServiceToClient): void {
    switch (message.type) {
      case 'robots': {
        const offers = new Map(message.robots.map(({ id, sdpOffer }) => [id, sdpOffer]));
        // After a restart of the service, the same id may belong to another robot, or the list may still be empty.
        for (const [id, robot] of [...this.#robots]) if (offers.get(id) !== robot.offer) this.#leave(id);
        for (const { id, name, sdpOffer, robotCandidates } of message.robots)
          this.#add(id, name, sdpOffer, robotCandidates);
        break;
      }
      case 'register': {
        const { id, name, sdpOffer, robotCandidates } = message.robot;
        this.#leave(id);
        this.#add(id, name, sdpOffer, robotCandidates);
        break;
      }
      case 'offer':
        this.#onOffer(message.robotId, message.sdpOffer);
        break;
      case 'candidate': {
        const robot = this.#robots.get(message.robotId);
        if (robot?.orphan === false) robot.connection.addCandidate(message.candidate);
        break;
      }
      case 'deregister':
        // The robot deregistered.
        if (message.robotId !== undefined) this.#remove(message.robotId);
        // Some services do not say which robot deregistered.
        else this.#events.send({ type: 'getRobots' });
        break;
      case 'deregistered':
        this.#leave(message.robotId);
        break;
    }
  }

  /** Drops orphans that have gone silent. Call this a few times a second. */
  expire(nowMs: number): void {
    for (const [id, { orphan, connection }] of [...this.#robots]) {
      if (orphan && !(connection.connected && nowMs - connection.lastPacketMs < ORPHAN_SILENCE_MS))
        this.#remove(id);
    }
  }

  /** Forgets all robots, for example when another service is named. */
  clear(): void {
    for (const id of [...this.#robots.keys()]) this.#remove(id);
  }

  close(): void {
    for (const { connection } of this.#robots.values()) connection.close();
    this.#robots.clear();
  }

  #onOffer(id: number, offer: string): void {
    const robot = this.#robots.get(id);
    if (robot === undefined || robot.orphan) {
      // It has failed, or came without an offer. The list has its name.
      this.#events.send({ type: 'getRobots' });
    } else if (sessionOf(offer) === sessionOf(robot.offer)) {
      robot.offer = offer;
      void this.#answer(id, robot);
    } else {
      // A different offer means another connection, not a change of the existing one.
      this.#remove(id);
      this.#add(id, robot.name, offer, []);
    }
  }

  #add(id: number, name: string, offer: string | null, candidates: readonly string[]): void {
    if (offer === null) return;
    const present = this.#robots.get(id);
    // The robot is listed again, so its registration has not ended after all.
    if (present?.offer === offer) present.orphan = false;
    if (present?.orphan === false || this.#spent.has(spentKey(id, offer))) return;
    if (present !== undefined) this.#rekey(id, present);
    if (this.#robots.size >= this.#options.maxRobots) {
      this.refused++;
      return;
    }
    const connection = new RobotConnection(this.#options, {
      onCandidate: (candidate) => this.#events.send({ type: 'candidate', robotId: id, candidate }),
      onReady: () => this.#onReady(connection),
      onFrame: (frame, lastPacketMs) => this.#events.onFrame(frame, lastPacketMs),
      onFailed: (detail) => {
        this.failed++;
        const now = this.#idOf(connection);
        this.#events.onRobotFailed(now ?? id, detail);
        if (now !== null) this.#remove(now);
      },
    });
    const robot: Robot = { name, offer, connection, orphan: false };
    this.#robots.set(id, robot);
    this.#selection.add(id, name);
    this.#events.onRobotsChanged();
    void this.#answer(id, robot);
    for (const candidate of candidates) connection.addCandidate(candidate);
  }

  #onReady(connection: RobotConnection): void {
    const id = this.#idOf(connection);
    if (id === null) return;
    const { name } = this.#robots.get(id) as Robot;
    // The same robot is here again, so its old connection is no longer needed.
    for (const [other, robot] of [...this.#robots])
      if (other !== id && robot.orphan && robot.name === name) this.#remove(other);
    connection.tell(this.#selection.wordFor(id));
  }

  async #answer(id: number, robot: Robot): Promise<void> {
    const [oldest] = this.#spent;
    if (oldest !== undefined && this.#spent.size >= MAX_SPENT_OFFERS) this.#spent.delete(oldest);
    this.#spent.add(spentKey(id, robot.offer));
    const sdpAnswer = await robot.connection.answer(robot.offer);
    if (sdpAnswer !== null) this.#events.send({ type: 'answer', robotId: id, sdpAnswer });
  }

  /** Handles the end of a registration. */
  #leave(id: number): void {
    const robot = this.#robots.get(id);
    if (robot === undefined || robot.orphan) return;
    if (robot.connection.connected && robot.connection.shown) robot.orphan = true;
    else this.#remove(id);
  }

  #rekey(id: number, robot: Robot): void {
    this.#robots.delete(id);
    const to = this.#nextOrphanId++;
    this.#robots.set(to, robot);
    this.#selection.rekey(id, to);
  }

  #remove(id: number): void {
    const robot = this.#robots.get(id);
    if (robot === undefined) return;
    this.#robots.delete(id);
    robot.connection.close();
    this.#selection.remove(id);
    this.#events.onRobotsChanged();
  }

  #idOf(connection: RobotConnection): number | null {
    for (const [id, robot] of this.#robots) if (robot.connection === connection) return id;
    return null;
  }
}

function spentKey(id: number, offer: string): string {
  return `${id} ${createHash('sha256').update(offer).digest('base64')}`;
}

/**
 * The parts that stay the same when a peer connection is renegotiated: the session's id (RFC 8866 §5.2) and the
 * certificate.
 */
function sessionOf(sdp: string): string {
  const session = /^o=\S+ (\S+)/m.exec(sdp)?.[1] ?? '';
  const fingerprint = /^a=fingerprint:(.*)$/m.exec(sdp)?.[1]?.trim() ?? '';
  return `${session} ${fingerprint}`;
}
