import {
  encodeJson,
  type IceServer,
  type OperatorToService,
  operatorToServiceCodec,
  PROTOCOL_VERSION,
  type RobotToService,
  robotToServiceCodec,
  type ServiceToOperator,
  type ServiceToRobot,
  type SessionEndReason,
  serviceToOperatorCodec,
  serviceToRobotCodec,
} from '@farpoint/protocol';
import type { AccessList } from './access.ts';
import { HubConnection, type HubConnectionOptions, type Refuse } from './farpoint-connection.ts';
import { ListingFeed } from './listing-feed.ts';
import { type Connection, closeCodes, type Peer } from './peer.ts';
import { type RobotEntry, RobotRegistry } from './robot-registry.ts';
import { type Session, type SessionLimits, SessionTable } from './session-table.ts';

export interface FarpointHubOptions extends HubConnectionOptions {
  readonly limits: HubConnectionOptions['limits'] & SessionLimits & { readonly maxRobots: number };
  readonly listIntervalMs: number;
  readonly listBytesPerSecond: number;
  readonly access: () => { readonly robots: AccessList; readonly operators: AccessList };
  /** What a peer of this name is told to use for ICE. */
  readonly iceServers: (name: string) => IceServer[];
  readonly makeHandle: () => string;
}

interface OperatorEntry {
  readonly name: string;
  readonly peer: Peer;
}

type HubSession = Session<RobotEntry, OperatorEntry>;

/** Introduces robots and operators over Farpoint's own protocol (see `@farpoint/protocol`, signaling/farpoint.ts). */
export class FarpointHub {
  readonly #options: FarpointHubOptions;
  readonly #registry: RobotRegistry;
  readonly #sessions: SessionTable<RobotEntry, OperatorEntry>;
  readonly #feed: ListingFeed;
  #operators = 0;

  constructor(options: FarpointHubOptions) {
    this.#options = options;
    this.#registry = new RobotRegistry(options.limits.maxRobots);
    this.#sessions = new SessionTable(options.limits, options.makeHandle);
    this.#feed = new ListingFeed({
      clock: options.clock,
      listing: this.#registry.listing,
      intervalMs: options.listIntervalMs,
      bytesPerSecond: options.listBytesPerSecond,
    });
  }

  get counts(): { robots: number; operators: number; sessions: number } {
    return { robots: this.#registry.size, operators: this.#operators, sessions: this.#sessions.size };
  }

  stop(): void {
    this.#feed.stop();
  }

  /** A socket on `/robot`. */
  robot(peer: Peer): Connection {
    return new HubConnection<RobotToService, RobotEntry>(peer, 'robot', robotToServiceCodec, this.#options, {
      hello: (message, end) => (message.type === 'robot.hello' ? this.#robotHello(peer, message, end) : null),
      message: (robot, message, end) => this.#robotMessage(robot, message, end),
      left: (robot) => this.#robotLeft(robot),
    });
  }

  /** A socket on `/operator`. */
  operator(peer: Peer): Connection {
    return new HubConnection<OperatorToService, OperatorEntry>(
      peer,
      'operator',
      operatorToServiceCodec,
      this.#options,
      {
        hello: (message, end) =>
          message.type === 'operator.hello' ? this.#operatorHello(peer, message, end) : null,
        message: (operator, message, end) => this.#operatorMessage(operator, message, end),
        left: (operator) => {
          this.#operators--;
          this.#feed.remove(operator.peer);
          this.#endAll(operator, 'operator-left');
        },
      },
    );
  }

  #robotHello(
    peer: Peer,
    hello: Extract<RobotToService, { type: 'robot.hello' }>,
    end: Refuse,
  ): RobotEntry | 'refused' {
    if (hello.protocol !== PROTOCOL_VERSION) return unsupported(hello.protocol, end);
    if (!this.#options.access().robots.allows(hello.token, hello.id)) {
      end('unauthorized', `the token does not allow robot ${hello.id}`, { fatal: true });
      return 'refused';
    }
    // Half a surrogate pair would take six characters in the list.
    const entry: RobotEntry = { id: hello.id, name: hello.name.toWellFormed(), key: hello.key, peer };
    const joined = this.#registry.join(entry);
    if (!joined.ok) {
      const why =
        joined.reason === 'full' ? 'no room for another robot' : `robot ${hello.id} is here with another key`;
      end(joined.reason, why, { fatal: true });
      return 'refused';
    }
    const { previous } = joined;
    if (previous !== null) {
      this.#endAll(previous, 'robot-left');
      previous.peer.close(closeCodes.policyViolation, 'a newer connection of this robot took over');
    }
    this.#options.observer.robotJoined('robot', entry.id, peer.address, previous !== null);
    toRobot(peer, { type: 'robot.welcome', id: entry.id, iceServers: this.#options.iceServers(entry.id) });
    if (joined.listed) this.#feed.changed();
    return entry;
  }

  #robotLeft(robot: RobotEntry): void {
    // Its place may have been taken by a newer socket, which then has had its sessions ended.
    if (!this.#registry.leave(robot)) return;
    this.#options.observer.robotLeft('robot', robot.id);
    this.#endAll(robot, 'robot-left');
    this.#feed.changed();
  }

  #robotMessage(robot: RobotEntry, message: RobotToService, refuse: Refuse): string | null {
    if (message.type === 'robot.hello') {
      refuse('malformed', 'only one robot.hello per connection');
      return null;
    }
    const session = this.#find(robot, message.session, refuse);
    if (session === null) return null;
    if (message.type === 'session.close') {
      this.#end(session, 'closed-by-robot');
      toOperator(session.operator.peer, {
        type: 'session.closed',
        session: session.handle,
        reason: 'closed-by-robot',
      });
      return null;
    }
    toOperator(session.operator.peer, message);
    return message.type;
  }

  #operatorHello(
    peer: Peer,
    hello: Extract<OperatorToService, { type: 'operator.hello' }>,
    end: Refuse,
  ): OperatorEntry | 'refused' {
    if (hello.protocol !== PROTOCOL_VERSION) return unsupported(hello.protocol, end);
    if (!this.#options.access().operators.allows(hello.token, null)) {
      end('unauthorized', 'operators need a token here', { fatal: true });
      return 'refused';
    }
    this.#operators++;
    toOperator(peer, {
      type: 'operator.welcome',
      iceServers: this.#options.iceServers(`operator-${peer.id}`),
    });
    this.#feed.add(peer);
    return { name: hello.name, peer };
  }

  #operatorMessage(operator: OperatorEntry, message: OperatorToService, refuse: Refuse): string | null {
    switch (message.type) {
      case 'operator.hello':
        refuse('malformed', 'only one operator.hello per connection');
        return null;
      case 'session.open':
        this.#open(operator, message.robotId, refuse);
        return null;
      case 'session.resume':
        this.#resume(operator, message, refuse);
        return null;
    }
    const session = this.#find(operator, message.session, refuse);
    if (session === null) return null;
    if (message.type === 'session.close') {
      this.#end(session, 'closed-by-operator');
      toRobot(session.robot.peer, {
        type: 'session.closed',
        session: session.handle,
        reason: 'closed-by-operator',
      });
      return null;
    }
    toRobot(session.robot.peer, message);
    return message.type;
  }

  #open(operator: OperatorEntry, robotId: string, refuse: Refuse): void {
    const robot = this.#registry.get(robotId);
    if (robot === undefined) {
      // No fault: it may have left a moment ago.
      refuse('unknown-robot', `robot ${robotId} is not here`, { fault: false });
      return;
    }
    const session = this.#sessions.open(robot, operator);
    if (session === null) {
      refuse('too-many-sessions', `no more sessions with robot ${robotId}: close one first`, {
        fault: false,
      });
      return;
    }
    this.#options.observer.sessionOpened(session.handle, robot.id, operator.name);
    // The operator first: it must know the handle before an offer can come.
    toOperator(operator.peer, { type: 'session.opened', session: session.handle, robotId });
    toRobot(robot.peer, { type: 'session.request', session: session.handle, operator: operator.name });
  }

  /**
   * Asks the robot to restart ICE in a session that its peers may still have, though this service may have forgotten it
   * with an earlier socket of theirs. Who knows the handle may: it is unguessable, and without the keys of the peers'
   * connection its messages cannot be read.
   */
  #resume(
    operator: OperatorEntry,
    { session: handle, robotId }: Extract<OperatorToService, { type: 'session.resume' }>,
    refuse: Refuse,
  ): void {
    const robot = this.#registry.get(robotId);
    if (robot === undefined) {
      refuse('unknown-robot', `robot ${robotId} is not here`, { session: handle, fault: false });
      return;
    }
    const known = this.#sessions.get(handle);
    if (known !== null && known.robot.id !== robotId) {
      refuse('unknown-session', 'not a session of yours', { session: handle, fault: false });
      return;
    }
    if (known?.operator !== operator || known.robot !== robot) {
      // The socket it was opened by may be half-open still, or gone.
      if (known !== null) this.#end(known, 'operator-left');
      if (this.#sessions.open(robot, operator, handle) === null) {
        refuse('too-many-sessions', `no more sessions with robot ${robotId}: close one first`, {
          session: handle,
          fault: false,
        });
        return;
      }
      this.#options.observer.sessionOpened(handle, robot.id, operator.name);
    }
    toOperator(operator.peer, { type: 'session.opened', session: handle, robotId });
    toRobot(robot.peer, { type: 'session.resume', session: handle, operator: operator.name });
  }

  #find(owner: RobotEntry | OperatorEntry, handle: string, refuse: Refuse): HubSession | null {
    const session = this.#sessions.find(handle, owner);
    // No fault: the other side may have closed it a moment ago.
    if (session === null) {
      refuse('unknown-session', 'not a session of yours', { session: handle, fault: false });
    }
    return session;
  }

  #end(session: HubSession, reason: SessionEndReason): void {
    this.#sessions.close(session);
    this.#options.observer.sessionClosed(session.handle, reason);
  }

  /** One side has left: tells every other side. */
  #endAll(owner: RobotEntry | OperatorEntry, reason: 'robot-left' | 'operator-left'): void {
    for (const session of this.#sessions.closeAll(owner)) {
      this.#options.observer.sessionClosed(session.handle, reason);
      const closed = { type: 'session.closed', session: session.handle, reason } as const;
      if (reason === 'robot-left') toOperator(session.operator.peer, closed);
      else toRobot(session.robot.peer, closed);
    }
  }
}

function unsupported(protocol: number, refuse: Refuse): 'refused' {
  refuse('unsupported-protocol', `protocol ${protocol} is not spoken here; ${PROTOCOL_VERSION} is`, {
    fatal: true,
  });
  return 'refused';
}

// Encoded anew from what was validated: the original text could hold a key twice, and readers differ on which one counts.
function toRobot(peer: Peer, message: ServiceToRobot): void {
  peer.send(encodeJson(serviceToRobotCodec, message));
}

function toOperator(peer: Peer, message: ServiceToOperator): void {
  peer.send(encodeJson(serviceToOperatorCodec, message));
}
