import {
  encodeJson,
  type IceServer,
  type OperatorToService,
  operatorToServiceCodec,
  PROTOCOL_VERSION,
  type RobotToService,
  robotToServiceCodec,
  serviceToRobotCodec,
} from '@farpoint/protocol';
import type { AccessList } from './access.ts';
import { HubConnection, type HubConnectionOptions, type Refuse } from './farpoint-connection.ts';
import { FarpointSessions, type OperatorEntry } from './farpoint-sessions.ts';
import { ListingFeed, type ListingSource } from './listing-feed.ts';
import { type Connection, closeCodes, type Peer } from './peer.ts';
import { toOperator, toRobot } from './peer-messages.ts';
import type { RelayLimits } from './relay-budget.ts';
import { type RobotEntry, RobotRegistry } from './robot-registry.ts';
import { RobotStatuses } from './robot-statuses.ts';
import type { SessionLimits } from './session-table.ts';

export interface FarpointHubOptions extends HubConnectionOptions {
  readonly limits: HubConnectionOptions['limits'] &
    SessionLimits &
    RelayLimits & { readonly maxRobots: number };
  readonly listIntervalMs: number;
  readonly listBytesPerSecond: number;
  readonly access: () => { readonly robots: AccessList; readonly operators: AccessList };
  /** The ICE servers that a peer with this name should use. */
  readonly iceServers: (name: string) => IceServer[];
  /** The lists of revoked grants that every robot gets; default none. */
  readonly revocations?: () => Iterable<string>;
  readonly makeHandle: () => string;
  /** Where operators sign in for a grant. */
  readonly signInUrl: string | null;
}

/**
 * Minimum time between two messages about statuses to an operator, ms. Chosen: people see no more than two changes a second
 * in a list. robot-statuses.test.ts holds it.
 */
const STATUS_INTERVAL_MS = 500;

/** Introduces robots and operators over Farpoint's own protocol (see `@farpoint/protocol`, signaling/farpoint.ts). */
export class FarpointHub {
  readonly #options: FarpointHubOptions;
  readonly #registry: RobotRegistry;
  readonly #sessions: FarpointSessions;
  readonly #feed: ListingFeed;
  readonly #statuses = new RobotStatuses();
  /** To operators that look at the list of robots. */
  readonly #statusFeed: ListingFeed;
  #operators = 0;

  constructor(options: FarpointHubOptions) {
    this.#options = options;
    this.#registry = new RobotRegistry(options.limits.maxRobots);
    this.#sessions = new FarpointSessions({ ...options, registry: this.#registry });
    const { clock, listIntervalMs, listBytesPerSecond } = options;
    const feed = (listing: ListingSource, intervalMs: number) =>
      new ListingFeed({ clock, listing, intervalMs, bytesPerSecond: listBytesPerSecond / 2 });
    this.#feed = feed(this.#registry.listing, listIntervalMs);
    this.#statusFeed = feed(this.#statuses.listing, Math.max(listIntervalMs, STATUS_INTERVAL_MS));
  }

  get counts(): { robots: number; operators: number; sessions: number } {
    return { robots: this.#registry.size, operators: this.#operators, sessions: this.#sessions.size };
  }

  stop(): void {
    this.#feed.stop();
    this.#statusFeed.stop();
  }

  /** Sends all robots a list of revoked grants. */
  tellRevocations(list: string): void {
    const message = new TextEncoder().encode(encodeJson(serviceToRobotCodec, { type: 'revocations', list }));
    for (const { peer } of this.#registry.values()) peer.send(message);
  }

  /** Handles a socket on `/robot`. */
  robot(peer: Peer): Connection {
    return new HubConnection<RobotToService, RobotEntry>(peer, 'robot', robotToServiceCodec, this.#options, {
      hello: (message, end) => (message.type === 'robot.hello' ? this.#robotHello(peer, message, end) : null),
      message: (robot, message, end) => this.#robotMessage(robot, message, end),
      left: (robot) => this.#robotLeft(robot),
    });
  }

  /** Handles a socket on `/operator`. */
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
          this.#options.observer.operatorLeft(operator.name);
          this.#feed.remove(operator.peer);
          this.#statusFeed.remove(operator.peer);
          this.#sessions.endAll(operator, 'operator-left');
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
        joined.reason === 'full'
          ? 'no room for another robot'
          : `robot ${hello.id} is already connected with another key`;
      end(joined.reason, why, { fatal: true });
      return 'refused';
    }
    const { previous } = joined;
    if (previous !== null) {
      this.#sessions.endAll(previous, 'robot-left');
      this.#forgetStatus(previous);
      previous.peer.close(closeCodes.policyViolation, 'a newer connection of this robot took over');
    }
    this.#options.observer.robotJoined('robot', entry.id, peer.address, previous !== null, hello.token);
    toRobot(peer, { type: 'robot.welcome', id: entry.id, iceServers: this.#options.iceServers(entry.id) });
    for (const list of this.#options.revocations?.() ?? []) toRobot(peer, { type: 'revocations', list });
    if (joined.listed) this.#feed.changed();
    return entry;
  }

  #robotLeft(robot: RobotEntry): void {
    // A newer socket may have taken its place. Its sessions have then already been ended.
    if (!this.#registry.leave(robot)) return;
    this.#options.observer.robotLeft('robot', robot.id);
    this.#sessions.endAll(robot, 'robot-left');
    this.#feed.changed();
    this.#forgetStatus(robot);
  }

  #forgetStatus(robot: RobotEntry): void {
    if (this.#statuses.forget(robot)) this.#statusFeed.changed();
  }

  #robotMessage(robot: RobotEntry, message: RobotToService, refuse: Refuse): string | null {
    if (message.type === 'robot.status') {
      if (this.#statuses.set(robot, message.status, this.#options.clock.now())) this.#statusFeed.changed();
      else refuse('rate-limited', 'too many statuses: slow down');
      return null;
    }
    if (message.type !== 'robot.hello') return this.#sessions.fromRobot(robot, message, refuse);
    refuse('malformed', 'only one robot.hello per connection');
    return null;
  }

  #operatorHello(
    peer: Peer,
    hello: Extract<OperatorToService, { type: 'operator.hello' }>,
    end: Refuse,
  ): OperatorEntry | 'refused' {
    if (hello.protocol !== PROTOCOL_VERSION) return unsupported(hello.protocol, end);
    if (!this.#options.access().operators.allows(hello.token, null)) {
      end('unauthorized', 'this service requires a token from operators', { fatal: true });
      return 'refused';
    }
    this.#operators++;
    this.#options.observer.operatorJoined(hello.name, peer.address, hello.token);
    toOperator(peer, {
      type: 'operator.welcome',
      iceServers: this.#options.iceServers(`operator-${peer.id}`),
      ...(this.#options.signInUrl === null ? {} : { signIn: this.#options.signInUrl }),
    });
    this.#feed.add(peer);
    return { name: hello.name, peer };
  }

  #operatorMessage(operator: OperatorEntry, message: OperatorToService, refuse: Refuse): string | null {
    if (message.type === 'statuses.watch') {
      if (message.on) this.#statusFeed.addLater(operator.peer);
      else this.#statusFeed.remove(operator.peer);
      return null;
    }
    if (message.type !== 'operator.hello') return this.#sessions.fromOperator(operator, message, refuse);
    refuse('malformed', 'only one operator.hello per connection');
    return null;
  }
}

function unsupported(protocol: number, refuse: Refuse): 'refused' {
  refuse('unsupported-protocol', `protocol ${protocol} is not supported; use ${PROTOCOL_VERSION}`, {
    fatal: true,
  });
  return 'refused';
}
