import {
  encodeJson,
  type OperatorEndReason,
  type OperatorToService,
  type RobotEndReason,
  type RobotToService,
  type ServiceToOperator,
  serviceToOperatorCodec,
  serviceToRobotCodec,
} from '@farpoint/protocol';
import type { Clock } from './clock.ts';
import type { Refuse } from './farpoint-connection.ts';
import type { Observer } from './observer.ts';
import type { Peer } from './peer.ts';
import { toOperator, toRobot } from './peer-messages.ts';
import { RelayBudgets, type RelayLimits } from './relay-budget.ts';
import { type ResumeClaim, ResumeClaims } from './resume-claims.ts';
import type { RobotEntry, RobotRegistry } from './robot-registry.ts';
import { type Session, type SessionLimits, SessionTable } from './session-table.ts';
import { UnansweredSessions } from './unanswered-sessions.ts';

/** A connected operator. */
export interface OperatorEntry {
  readonly name: string;
  readonly peer: Peer;
}

export interface FarpointSessionsOptions {
  readonly registry: RobotRegistry;
  readonly observer: Observer;
  readonly limits: SessionLimits & RelayLimits;
  readonly clock: Pick<Clock, 'now'>;
  readonly makeHandle: () => string;
}

type FromRobot = Exclude<RobotToService, { type: 'robot.hello' | 'robot.status' }>;
type FromOperator = Exclude<OperatorToService, { type: 'operator.hello' | 'statuses.watch' }>;
type HubSession = Session<RobotEntry, OperatorEntry>;
type Claim = ResumeClaim<RobotEntry, OperatorEntry>;

/** What a request for a session takes of the budgets: more than its bytes, because the robot has work with it. */
const REQUEST_BYTES = 1024;

/** What an operator is told if its session is not resumed. */
const refusalWords = {
  'wrong-resume-key': 'the robot refused: the key does not belong to the operator of this session',
  'resume-too-soon': 'the robot has just sent an offer, or is not connected yet: ask again in a second',
} as const;

/** Relays what robots and operators say about their sessions to the other side. */
export class FarpointSessions {
  readonly #options: FarpointSessionsOptions;
  readonly #sessions: SessionTable<RobotEntry, OperatorEntry>;
  readonly #claims: ResumeClaims<RobotEntry, OperatorEntry>;
  readonly #unanswered = new UnansweredSessions<HubSession>();
  readonly #budgets: RelayBudgets;

  constructor(options: FarpointSessionsOptions) {
    this.#options = options;
    const { limits, makeHandle } = options;
    this.#sessions = new SessionTable(limits, makeHandle);
    this.#budgets = new RelayBudgets(limits);
    this.#claims = new ResumeClaims(limits.maxSessionsPerOperator, makeHandle);
  }

  get size(): number {
    return this.#sessions.size;
  }

  /** @returns the type of the message if it was relayed */
  fromRobot(robot: RobotEntry, message: FromRobot, refuse: Refuse): string | null {
    if (message.type === 'session.refuse') {
      this.#refuseClaim(robot, message);
      return null;
    }
    if (message.type === 'session.offer') return this.#offer(robot, message, refuse);
    const session = this.#find(robot, message.session, refuse);
    if (session === null) return null;
    if (message.type === 'session.close') {
      const { reason = 'closed-by-robot', maxOperators, detail } = message;
      this.#end(session, reason);
      toOperator(session.operator.peer, {
        type: 'session.closed',
        session: session.handle,
        reason,
        maxOperators,
        detail,
      });
      return null;
    }
    return this.#relayToOperator(session, message, refuse);
  }

  /** @returns the type of the message if it was relayed */
  fromOperator(operator: OperatorEntry, message: FromOperator, refuse: Refuse): string | null {
    if (message.type === 'session.open') {
      this.#open(operator, message.robotId, refuse);
      return null;
    }
    if (message.type === 'session.resume') {
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
    const text = encodeJson(serviceToRobotCodec, message);
    if (!this.#mayRelay(operator, session.robot, text.length, refuse, session.handle)) return null;
    if (message.type === 'session.answer') this.#unanswered.remove(session);
    session.robot.peer.send(text);
    return message.type;
  }

  #offer(
    robot: RobotEntry,
    message: Extract<RobotToService, { type: 'session.offer' }>,
    refuse: Refuse,
  ): string | null {
    const { claim: claimed, session: handle, ...offer } = message;
    const claim = claimed === undefined ? null : this.#claims.take(claimed, handle, robot);
    const session = claim === null ? this.#find(robot, handle, refuse) : this.#bind(claim, refuse);
    if (session === null) return null;
    return this.#relayToOperator(session, { ...offer, session: handle }, refuse);
  }

  #relayToOperator(
    { operator, handle }: HubSession,
    message: Extract<ServiceToOperator, { type: 'session.offer' | 'session.candidate' }>,
    refuse: Refuse,
  ): string | null {
    const text = encodeJson(serviceToOperatorCodec, message);
    if (this.#budgets.refusal(null, operator.peer, text.length, this.#options.clock.now()) !== null) {
      refuse('rate-limited', 'too much for this operator: slow down', { session: handle, fault: false });
      return null;
    }
    operator.peer.send(text);
    return message.type;
  }

  /** Whether budgets allow a message to a robot. What an operator sends beyond its own share is a fault. */
  #mayRelay(
    operator: OperatorEntry,
    robot: RobotEntry,
    bytes: number,
    refuse: Refuse,
    session?: string,
  ): boolean {
    const refusal = this.#budgets.refusal(operator.peer, robot.peer, bytes, this.#options.clock.now());
    if (refusal === null) return true;
    const words =
      refusal === 'sender'
        ? 'you send too much: slow down'
        : `too much for robot ${robot.id}: try again in a moment`;
    refuse('rate-limited', words, {
      ...(session === undefined ? {} : { session }),
      fault: refusal === 'sender',
    });
    return false;
  }

  #open(operator: OperatorEntry, robotId: string, refuse: Refuse): void {
    const robot = this.#options.registry.get(robotId);
    if (robot === undefined) {
      // Not a fault: the robot may have left a moment ago.
      refuse('unknown-robot', `robot ${robotId} is not connected`, { fault: false });
      return;
    }
    if (!this.#mayRelay(operator, robot, REQUEST_BYTES, refuse)) return;
    const room = this.#unanswered.hasRoom(robotId, operator.peer.address);
    const session = room ? this.#sessions.open(robot, operator) : null;
    if (session === null) {
      this.#tooMany(robotId, refuse);
      return;
    }
    this.#unanswered.add(session);
    this.#options.observer.sessionOpened(session.handle, robot.id, operator.name);
    // The operator first, because it must know the handle before an offer can arrive.
    toOperator(operator.peer, { type: 'session.opened', session: session.handle, robotId });
    toRobot(robot.peer, { type: 'session.request', session: session.handle, operator: operator.name });
  }

  /**
   * Asks the robot to restart ICE in a session that its peers may still have, even if this service has forgotten it
   * with an earlier socket of theirs. Nothing changes until the robot has confirmed that the asker's key belongs to
   * the session, so that merely knowing the handle is not enough to disturb anybody.
   */
  #resume(
    operator: OperatorEntry,
    { session: handle, robotId, resumeKey }: Extract<OperatorToService, { type: 'session.resume' }>,
    refuse: Refuse,
  ): void {
    const robot = this.#options.registry.get(robotId);
    if (robot === undefined) {
      refuse('unknown-robot', `robot ${robotId} is not connected`, { session: handle, fault: false });
      return;
    }
    const known = this.#sessions.get(handle);
    if (known !== null && known.robot.id !== robotId) {
      refuse('unknown-session', 'you have no such session', { session: handle, fault: false });
      return;
    }
    if (!this.#sessions.hasRoom(robot, operator, known)) {
      this.#tooMany(robotId, refuse, handle);
      return;
    }
    if (!this.#mayRelay(operator, robot, REQUEST_BYTES, refuse, handle)) return;
    const claim = this.#claims.add(handle, robot, operator);
    toOperator(operator.peer, { type: 'session.resuming', session: handle });
    toRobot(robot.peer, {
      type: 'session.resume',
      session: handle,
      operator: operator.name,
      claim: claim.handle,
      resumeKey,
    });
  }

  /**
   * Binds a session to the present sockets, because the robot has accepted a claim. @returns the session in which its
   * offer continues
   */
  #bind(claim: Claim, refuse: Refuse): HubSession | null {
    const { session: handle, robot, operator } = claim;
    const known = this.#sessions.get(handle);
    const fits = known === null || known.robot.id === robot.id;
    if (!fits || !this.#sessions.hasRoom(robot, operator, known)) {
      refuse('unknown-session', 'you have no such session', { session: handle, fault: false });
      return null;
    }
    let session = known;
    if (session === null || session.operator !== operator || session.robot !== robot) {
      // The socket that opened it may be half-open or gone.
      if (session !== null) this.#end(session, 'operator-left');
      session = this.#sessions.open(robot, operator, handle);
      this.#options.observer.sessionOpened(handle, robot.id, operator.name);
    }
    toOperator(operator.peer, { type: 'session.opened', session: handle, robotId: robot.id });
    return session;
  }

  /** The robot refuses to resume the session for the asker. Nobody else is told. */
  #refuseClaim(robot: RobotEntry, message: Extract<RobotToService, { type: 'session.refuse' }>): void {
    const { session, code } = message;
    const claim = this.#claims.take(message.claim, session, robot);
    if (claim === null) return;
    const { peer } = claim.operator;
    this.#options.observer.rejected('operator', code, '');
    if (code !== 'unknown-session') {
      toOperator(peer, { type: 'error', code, message: refusalWords[code], session });
      return;
    }
    const known = this.#sessions.find(session, claim.operator);
    if (known !== null) this.#end(known, code);
    toOperator(peer, { type: 'session.closed', session, reason: code });
  }

  #tooMany(robotId: string, refuse: Refuse, session?: string): void {
    refuse('too-many-sessions', `too many sessions with robot ${robotId}: close one first`, {
      ...(session === undefined ? {} : { session }),
      fault: false,
    });
  }

  #find(owner: RobotEntry | OperatorEntry, handle: string, refuse: Refuse): HubSession | null {
    const session = this.#sessions.find(handle, owner);
    // Not a fault: the other side may have closed it a moment ago.
    if (session === null) {
      refuse('unknown-session', 'you have no such session', { session: handle, fault: false });
    }
    return session;
  }

  #end(session: HubSession, reason: OperatorEndReason | RobotEndReason): void {
    this.#sessions.close(session);
    this.#unanswered.remove(session);
    this.#options.observer.sessionClosed(session.handle, reason);
  }

  /** Ends all sessions of a side that has left, and tells the other sides. */
  endAll(owner: RobotEntry | OperatorEntry, reason: 'robot-left' | 'operator-left'): void {
    this.#claims.drop(owner);
    for (const session of this.#sessions.closeAll(owner)) {
      const { handle, robot, operator } = session;
      this.#unanswered.remove(session);
      this.#options.observer.sessionClosed(handle, reason);
      if (reason === 'robot-left')
        toOperator(operator.peer, { type: 'session.closed', session: handle, reason });
      else toRobot(robot.peer, { type: 'session.closed', session: handle, reason });
    }
  }
}
