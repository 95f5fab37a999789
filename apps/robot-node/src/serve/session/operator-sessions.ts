import { shortHash } from '@farpoint/audit';
import type { RateController } from '@farpoint/congestion';
import type { AdmissionRequest } from '@farpoint/grants';
import type { IceServer, RobotToService, ServiceToRobot, VideoCodec } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { openAccess } from '../../admit/access/access.ts';
import type { GrantFiles } from '../../admit/access/grant-files.ts';
import { OperatorRoster } from '../../admit/access/operator-roster.ts';
import { RobotAccess } from '../../admit/access/robot-access.ts';
import type { RobotKey } from '../../admit/access/robot-key-file.ts';
import { SIGNALING } from '../../admit/access/robot-revocations.ts';
import type { AuditedOperator, RobotAudit } from '../../admit/audit/robot-audit.ts';
import { monotonicMs } from '../../ground/clock.ts';
import type { RobotCounters } from '../../ground/robot-counters.ts';
import type { Budgets } from '../../send/budgets/budgets.ts';
import type { CloudClaim } from '../../send/budgets/cloud-shares.ts';
import type { PacketLog } from '../../send/transport/packet-log.ts';
import type { OperatorPeerOptions, PeerEnd } from '../../send/transport/peer-events.ts';
import type { SendLoop } from '../../send/transport/send-loop.ts';
import { CommandDesk } from '../commands/command-desk.ts';
import type { RobotCommands } from '../commands/open-commands.ts';
import { People } from '../people/people.ts';
import { Pointing } from '../people/pointing.ts';
import type { SessionHost } from './operator-messages.ts';
import { OperatorPlaces, type OperatorPlacesOptions } from './operator-places.ts';
import { OperatorSession } from './operator-session.ts';
import type { ResumeRequest } from './path-keeper.ts';
import { WaitingPlaces } from './waiting-places.ts';

export interface OperatorSessionsOptions {
  /** The robot's. */
  id: string;
  /** `null` if everybody is admitted. */
  grants: GrantFiles | null;
  /** `null`: operators cannot recognise the robot. */
  robotKey: RobotKey | null;
  /** How many operators there may be, and of one person. */
  places: OperatorPlacesOptions;
  /** Whether operators whose grant lets them only watch may point at a spot that the others see. */
  watchersPoint: boolean;
  /** In addition to the signaling service's ICE servers. */
  iceServers: readonly IceServer[];
  peer: Omit<OperatorPeerOptions, 'iceServers'>;
  /** The largest share of a path that pictures may take, 0–1. */
  pictureShare: number;
  makeController: (transportFeedback: boolean) => RateController;
  /** What the robot's cloud sensors claim of a path, indexed by sensor number. */
  claims: () => readonly CloudClaim[];
  budgets: Pick<Budgets, 'update'>;
  mostVideoBitsPerSecond: (video: number, codecs: ReadonlySet<VideoCodec>) => number;
  sendLoop: SendLoop;
  packetLog: PacketLog | undefined;
  host: SessionHost;
  signaling: { send(message: RobotToService): boolean };
  counters: RobotCounters;
  audit: RobotAudit;
  /** What operators may make the robot do besides driving. */
  commands: RobotCommands;
  /** Whether the robot stands still. */
  stands: () => boolean;
  log: Logger;
}

export interface OperatorSessionsEvents {
  /** Somebody asks for a new path for a session that has lost its old one. */
  resume: (request: ResumeRequest, iceServers: readonly IceServer[]) => void;
  connected: (operator: OperatorSession) => void;
  cloudFormats: (operator: OperatorSession) => void;
  needsKeyFrame: (video: number) => void;
  latencyFrameLost: () => void;
  /** The operator has been removed from `operators`. */
  ended: (operator: OperatorSession, end: PeerEnd) => void;
  /** The operator of a session that has ended meant its end. */
  left: (session: string) => void;
}

/** The sessions with operators, each with its own connection. Signaling opens and closes them. */
export class OperatorSessions {
  readonly operators = new Map<string, OperatorSession>();
  readonly #options: OperatorSessionsOptions;
  readonly #events: OperatorSessionsEvents;
  readonly #access: RobotAccess | null;
  readonly #roster = new OperatorRoster();
  readonly #people: People;
  readonly #commands: CommandDesk;
  readonly #pointing: Pointing;
  readonly #waiting = new WaitingPlaces();
  /** `null` if everybody is admitted: then nobody is known by anything but a name of its own choice. */
  readonly #places: OperatorPlaces | null;
  #iceServers: readonly IceServer[] = [];

  constructor(options: OperatorSessionsOptions, events: OperatorSessionsEvents) {
    this.#options = options;
    this.#events = events;
    const { grants: files, id: robot, counters, audit, host, log } = options;
    const { operators } = this;
    const roster = this.#roster;
    this.#people = new People({ operators, roster, host, counters, log });
    this.#commands = new CommandDesk({
      operators,
      roster,
      drive: host.drive,
      now: () => host.now(),
      counters,
      audit,
      log,
      commands: options.commands,
      stands: options.stands,
    });
    const { watchersPoint } = options;
    this.#pointing = new Pointing({ operators, roster, watchersPoint, counters, now: monotonicMs });
    const { grantsRefused: refusals, revocationLists } = counters;
    const onRefused = (operator: AuditedOperator, reason: string) =>
      audit.refused('admission', reason, operator);
    this.#places = files === null ? null : new OperatorPlaces(options.places);
    const clocks = { nowS: () => Date.now() / 1000, now: monotonicMs };
    this.#access =
      files === null
        ? null
        : new RobotAccess({ files, robot, refusals, revocationLists, onRefused, roster, log, ...clocks });
  }

  /** Notes the driver, enforces the grants, and tells everybody who is here. Call every 25 ms. */
  update(): void {
    const { leaseHolder } = this.#options.host.drive.guard;
    this.#places?.noteDriver(leaseHolder, monotonicMs());
    if (this.#access !== null) this.#access.enforce(this.operators, leaseHolder);
    else this.#roster.sendDue(this.operators.values(), leaseHolder, monotonicMs());
    this.#people.update();
    this.#commands.update();
  }

  /** Reads keys and revocations again; the old keys stay in force if that fails. @throws {GrantKeysError} */
  async reloadGrants(): Promise<void> {
    await this.#access?.reload(() => this.operators.values());
  }

  onSignaling(message: ServiceToRobot): void {
    switch (message.type) {
      case 'robot.welcome':
        this.#iceServers = [...message.iceServers, ...this.#options.iceServers];
        break;
      case 'session.request':
        void this.#open(message.session, message.operator);
        break;
      case 'session.resume':
        this.#events.resume(message, this.#iceServers);
        break;
      case 'session.answer':
        void this.#answer(message);
        break;
      case 'session.candidate':
        this.operators.get(message.session)?.peer.addCandidate(message.candidate);
        break;
      case 'session.closed': {
        const operator = this.operators.get(message.session);
        // The end of its connection may come first, as if that had been lost.
        if (operator === undefined && message.reason === 'closed-by-operator')
          this.#events.left(message.session);
        // Only a signaling connection was lost, the operator's or ours: the session lives on with its connection.
        if (message.reason === 'operator-left' && operator?.peer.connected) break;
        operator?.peer.close('closed', message.reason);
        break;
      }
      case 'revocations':
        void this.#access?.revocations.take(message.list, SIGNALING);
        break;
      case 'error':
        this.#onError(message);
        break;
    }
  }

  /** Cancels the robot's commands that run. */
  closeCommands(): Promise<void> {
    return this.#commands.close();
  }

  /** Ends all sessions and tells the signaling service. */
  close(): void {
    this.#access?.close();
    for (const operator of [...this.operators.values()]) {
      const { id: session } = operator.messages;
      this.#options.signaling.send({ type: 'session.close', session, reason: 'shutting-down' });
      operator.peer.close('closed', 'the robot is shutting down');
    }
  }

  #onError({ code, session, message }: Extract<ServiceToRobot, { type: 'error' }>): void {
    const { counters, log } = this.#options;
    counters.signalingErrors.add(code);
    log.warn({ code, session: shown(session), detail: message }, 'signaling refused');
    if (session === undefined || code !== 'unknown-session') return;
    const operator = this.operators.get(session);
    if (operator !== undefined && !operator.peer.connected) operator.peer.close('closed', message);
  }

  async #answer(message: AdmissionRequest): Promise<void> {
    const { session, sdp } = message;
    const operator = this.operators.get(session);
    if (operator === undefined) return;
    const admitted = this.#access === null || (await this.#access.admits(operator, message));
    // Refused, or ended while its grant was verified.
    if (this.operators.get(session) !== operator) return;
    if (admitted && !this.#placed(operator)) return;
    const { subject } = operator.messages.access;
    if (admitted && subject !== null) this.#options.host.drive.guard.identify(session, subject);
    const verdict = admitted ? await operator.answer(sdp) : 'unasked';
    if (verdict === 'taken') {
      this.#waiting.answered(session);
      return;
    }
    this.#options.counters.answersIgnored.add(verdict);
    this.#options.log.debug({ session: shown(session), verdict }, 'answer ignored');
  }

  /** Ends the session of an admitted operator for whom there is no place. @returns whether there is one */
  #placed(operator: OperatorSession): boolean {
    const { leaseHolder } = this.#options.host.drive.guard;
    const refused = this.#places?.enter(operator, this.operators, leaseHolder, monotonicMs()) ?? null;
    if (refused === null) return true;
    this.#options.counters.sessionsRefused++;
    this.#options.audit.refused('session', 'robot-full', operator.messages);
    operator.peer.close('robot-full', refused);
    return false;
  }

  async #open(session: string, operatorName: string): Promise<void> {
    if (this.operators.has(session)) {
      // To reconnect to an open session, an operator must use session.resume.
      this.#options.log.warn({ session: shown(session) }, 'an open session was requested again');
      return;
    }
    const now = monotonicMs();
    if (!this.#hasPlace(session, operatorName, now)) return;
    const log = this.#options.log.child({ session: shown(session), operator: operatorName });
    const operator = this.#makeSession(session, operatorName, log);
    this.operators.set(session, operator);
    this.#waiting.requested(session, now);
    this.#options.counters.sessionsOpened++;
    log.info('session requested');
    await this.#offer(operator, log);
  }

  /** Refuses the session if the robot is full. A connection that takes too long makes room. */
  #hasPlace(session: string, operatorName: string, now: number): boolean {
    const { places, counters, signaling } = this.#options;
    const most = this.#places?.mostSessions ?? places.most;
    if (this.operators.size >= most) {
      const overdue = this.operators.get(this.#waiting.overdue(now) ?? '');
      overdue?.peer.close('not-connected', 'somebody else asked for a place before the connection was there');
    }
    if (this.operators.size < most) return true;
    counters.sessionsRefused++;
    this.#options.audit.refused('session', 'robot-full', { id: session, access: openAccess(operatorName) });
    this.#options.log.warn(
      { session: shown(session), operators: this.operators.size },
      'session refused: the robot is full',
    );
    signaling.send({ type: 'session.close', session, reason: 'robot-full', maxOperators: places.most });
    return false;
  }

  #makeSession(session: string, operatorName: string, log: Logger): OperatorSession {
    const { host, signaling, counters, peer, pictureShare, makeController } = this.#options;
    const { claims, budgets, sendLoop, packetLog } = this.#options;
    const operator: OperatorSession = new OperatorSession(
      {
        session,
        operatorName,
        packetLog,
        pictureShare,
        peer: { ...peer, iceServers: this.#iceServers },
        makeController,
        claims,
        budgets,
        mostVideoBitsPerSecond: this.#options.mostVideoBitsPerSecond,
      },
      host,
      sendLoop,
      {
        onCandidate: (candidate) => signaling.send({ type: 'session.candidate', session, candidate }),
        onCandidateRefused: (reason, detail) => {
          counters.candidatesRefused.add(reason);
          log.debug({ reason, detail }, 'candidate refused');
        },
        onConnected: () => {
          this.#options.audit.sessionBegan(operator.messages);
          this.#waiting.settled(session);
          log.info({ operators: this.operators.size }, 'operator connected');
          this.#events.connected(operator);
          this.#commands.welcome(operator);
          operator.messages.send(this.#pointing.told(operator));
        },
        onCloudFormats: () => this.#events.cloudFormats(operator),
        onNeedsKeyFrame: (video) => this.#events.needsKeyFrame(video),
        onLatencyFrameLost: () => this.#events.latencyFrameLost(),
        onEnded: (end, detail) => this.#ended(operator, end, detail, log),
      },
    );
    operator.messages.onEndSession = (request) =>
      this.#access?.endSession(operator, request, this.operators.values());
    operator.messages.onCommandRequest = (request) => this.#commands.request(operator, request);
    operator.messages.onDriveRequest = (request) => this.#people.request(operator, request);
    operator.messages.onPoint = (point) => this.#pointing.point(operator, point);
    return operator;
  }

  async #offer(operator: OperatorSession, log: Logger): Promise<void> {
    const { robotKey, id: robot, signaling } = this.#options;
    const { id: session } = operator;
    try {
      const sdp = await operator.peer.offer();
      const identity = await robotKey?.identify({ robot, session, offer: sdp }, Date.now() / 1000);
      if (this.operators.get(session) !== operator) return;
      this.#access?.offered(operator, sdp);
      const signed = identity === undefined ? {} : { identity };
      signaling.send({ type: 'session.offer', session, sdp, ...signed });
    } catch (error) {
      log.error({ err: error }, 'no offer');
      operator.peer.close('not-connected', 'no offer could be made');
    }
  }

  #ended(operator: OperatorSession, end: PeerEnd, detail: string, log: Logger): void {
    const { counters, signaling, audit } = this.#options;
    const { id } = operator.messages;
    this.operators.delete(id);
    this.#waiting.settled(id);
    this.#access?.forget(id);
    this.#places?.ended(operator, end, monotonicMs());
    this.#events.ended(operator, end);
    this.#people.gone(id);
    audit.sessionEnded(operator.messages, end, detail);
    counters.sessionsEnded.add(end);
    log.info({ end, detail, operators: this.operators.size }, 'session ended');
    // The other side knows already: we told it, or it told us.
    if (end === 'closed') return;
    const full = end === 'robot-full' ? { maxOperators: this.#options.places.most } : {};
    signaling.send({
      type: 'session.close',
      session: id,
      reason: end,
      ...full,
      detail: detail.slice(0, 300),
    });
  }
}

/** Handles are secrets: who knows one can ask for a session to be resumed. */
function shown(session: string | undefined): string | undefined {
  return session === undefined ? undefined : shortHash('session', session);
}
