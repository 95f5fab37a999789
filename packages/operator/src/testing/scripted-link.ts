/**
 * A link without a robot, a signaling service or a socket: a script says what the service and the robot do, by the real
 * codecs, and reads what the client sends. Phases, losses and retries are those of the direct link.
 */
import {
  type Command,
  decodeJson,
  encodeJson,
  type OperatorControlMessage,
  type OperatorSessionMessage,
  operatorControlCodec,
  operatorSessionCodec,
  type RobotControlMessage,
  type RobotEndReason,
  type RobotListing,
  type RobotSessionMessage,
  robotControlCodec,
  robotSessionCodec,
  type TelemetryMessage,
  telemetryCodec,
} from '@farpoint/protocol';
import type { ChangedRobotKey } from '../access/session-admission.ts';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import type { RobotLink, RobotLinkEvents } from '../link/robot-link.ts';
import { type RobotChannel, RobotSession } from '../session/robot-session.ts';
import { SessionKeeper, type SessionPhase } from '../session/session-keeper.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import type { SignalingState } from '../signaling/signaling-state.ts';
import type { CloudWorkerHere } from './cloud-worker-here.ts';

const [TICK_MS, PROBE_MS] = [250, 500];
/** Neither the shortest nor the longest of the random waits. */
const MIDDLE = 0.5;

/** Everything that a client sends to a robot. */
export type SentMessage = OperatorSessionMessage | OperatorControlMessage;
/** Everything that a robot sends to a client. */
export type ToldMessage = RobotSessionMessage | RobotControlMessage | TelemetryMessage;

/** What a script does about the link. */
export interface LinkScript {
  /** The client asks for a session with this robot. {@link ScriptedLink.admit} opens it. */
  onRequest(robotId: string): void;
  /** The client has sent something, and the path carries it. */
  onSent(message: SentMessage): void;
}

export class ScriptedLink implements RobotLink {
  /** What the client has sent in all sessions, in this order; also what was lost on a path that is cut. */
  readonly sent: SentMessage[] = [];
  sessionsOpened = 0;
  lastLoss: SessionLoss | null = null;
  lossDetail: string | null = null;
  signInUrl: string | null = null;
  changedRobotKey: ChangedRobotKey | null = null;
  maxOperators: number | null = null;
  robots: readonly RobotListing[] = [];
  signaling: SignalingState = 'waiting';
  session: RobotSession;
  /** Whether packets arrive, in both directions. */
  isCut = false;
  readonly #worker: CloudWorkerHere;
  readonly #events: RobotLinkEvents;
  readonly #script: LinkScript;
  readonly #keeper: SessionKeeper;
  #generation = 0;
  #lastHeardMs = 0;
  #probeDueMs = 0;
  #timer: ReturnType<typeof setInterval> | undefined;

  constructor(worker: CloudWorkerHere, events: RobotLinkEvents, script: LinkScript) {
    this.#worker = worker;
    this.#events = events;
    this.#script = script;
    this.session = new RobotSession(events);
    this.#keeper = new SessionKeeper(
      {
        requestSession: (robotId) => script.onRequest(robotId),
        resumeSession: () => undefined,
        closeSession: () => undefined,
        dropPeer: () => undefined,
        onPhase: (phase) => {
          if (phase === 'live') this.sessionsOpened++;
          if (phase === 'opening') [this.lossDetail, this.changedRobotKey] = [null, null];
          events.onPhase(phase);
        },
        onLoss: (loss) => {
          this.lastLoss = loss;
          events.onLoss(loss);
        },
        onPath: (up) => events.onPath(up),
      },
      () => MIDDLE,
    );
  }

  /** The connection to the signaling service is in this state now. */
  enterSignaling(state: SignalingState): void {
    this.signaling = state;
    this.#keeper.onSignaling(state === 'ready', performance.now());
    this.#events.onSignaling(state);
  }

  /** The service lists these robots now. */
  list(robots: readonly RobotListing[]): void {
    this.robots = robots;
    this.#keeper.onRobots(robots, performance.now());
    this.#events.onRobots(robots);
  }

  /** The requested session is there: the robot's messages come next. */
  admit(): void {
    const nowMs = performance.now();
    this.#generation++;
    this.#keeper.onOpened(this.#name, this.robotId ?? '');
    this.session = new RobotSession(this.#events);
    this.#events.onGeneration(this.#generation);
    this.#worker.begin(this.#generation);
    this.#lastHeardMs = nowMs;
    this.#keeper.onPeerConnected(nowMs);
  }

  /** The robot ends the session, or refuses it. @param maxOperators of a robot that is full */
  end(reason: RobotEndReason, detail: string | null = null, maxOperators: number | null = null): void {
    if (this.#keeper.session === null) this.#keeper.onOpened(this.#name, this.robotId ?? '');
    this.lossDetail = detail;
    if (maxOperators !== null) this.maxOperators = maxOperators;
    this.#keeper.onClosed(this.#name, reason, performance.now());
  }

  /** The client itself gives the session up. @param changed the keys, after `robot-key-changed` */
  fail(loss: SessionLoss, changed: ChangedRobotKey | null = null): void {
    this.changedRobotKey = changed;
    this.#keeper.onPeerFailed(performance.now(), loss);
  }

  /** The service refuses a request, in these words. */
  refuse(message: string): void {
    this.#events.onRefusal(message);
    this.#keeper.onRefused(undefined, performance.now());
  }

  /** The robot sends this. It is lost on a path that is cut. */
  tell(message: ToldMessage): void {
    if (message.type === 'clockAnswer' || message.type === 'estopAck')
      this.receive('control', encodeJson(robotControlCodec, message));
    else if (isTelemetry(message)) this.receive('telemetry', encodeJson(telemetryCodec, message));
    else this.receive('session', encodeJson(robotSessionCodec, message));
  }

  /** Data come on a channel, whatever they are. */
  receive(channel: RobotChannel, data: string | Uint8Array): void {
    if (this.isCut || this.phase !== 'live') return;
    const nowMs = performance.now();
    this.#heard(nowMs);
    if (channel === 'control') this.#keeper.onAnswered(nowMs);
    const malformed = this.session.malformed;
    this.session.onMessage(channel, data, nowMs);
    if (this.session.malformed > malformed)
      throw new Error(`a robot would not send this on ${channel}: ${data}`);
  }

  /** A packet of the robot's clouds comes. @param sequence its number */
  receivePacket(payload: ArrayBuffer, sequence: number): void {
    if (!this.isCut && this.phase === 'live') this.#worker.take(payload, sequence);
  }

  start(): void {
    this.#timer ??= setInterval(() => this.#tick(performance.now()), TICK_MS);
  }

  close(): void {
    clearInterval(this.#timer);
    this.disconnect();
  }

  connect(robotId: string): void {
    this.#keeper.want(robotId, this.robots, performance.now());
  }

  retry(): void {
    this.#keeper.retry(performance.now());
  }

  disconnect(): void {
    this.#keeper.want(null, this.robots, performance.now());
  }

  get phase(): SessionPhase {
    return this.#keeper.phase;
  }
  get robotId(): string | null {
    return this.#keeper.robotId;
  }
  get robotListed(): boolean {
    return this.#keeper.robotListed;
  }
  get interrupted(): boolean {
    return this.#keeper.interrupted;
  }

  silentMs(nowMs: number): number {
    return nowMs - this.#lastHeardMs;
  }

  sendCommand(command: Command): void {
    if (!this.interrupted) this.sendControl(command);
  }

  sendControl(message: OperatorControlMessage): void {
    if (this.phase !== 'live') return;
    this.#send(decodeJson(operatorControlCodec, encodeJson(operatorControlCodec, message)));
  }

  sendSession(message: OperatorSessionMessage): void {
    if (this.phase !== 'live') return;
    this.#send(decodeJson(operatorSessionCodec, encodeJson(operatorSessionCodec, message)));
  }

  limitBandwidth(): void {}

  onPoints(nowMs: number): void {
    this.#heard(nowMs);
  }

  sendReport(_report: IntakeReport): void {}

  get #name(): string {
    return `scripted-${this.#generation}`;
  }

  #send(message: SentMessage): void {
    this.sent.push(message);
    if (!this.isCut) this.#script.onSent(message);
  }

  #heard(nowMs: number): void {
    this.#lastHeardMs = nowMs;
    this.#keeper.onHeard(nowMs);
  }

  #tick(nowMs: number): void {
    this.#keeper.tick(nowMs);
    if (this.phase !== 'live' || nowMs < this.#probeDueMs) return;
    this.#probeDueMs = nowMs + PROBE_MS;
    this.sendControl({ type: 'clockProbe', id: this.session.nextProbeId(), sentMs: nowMs });
  }
}

/** Every type of the telemetry channel. */
const TELEMETRY: Readonly<Record<TelemetryMessage['type'], true>> = {
  telemetry: true,
  nearField: true,
  reading: true,
  samples: true,
  diagnostics: true,
  path: true,
  map: true,
  joints: true,
};

function isTelemetry(message: ToldMessage): message is TelemetryMessage {
  return message.type in TELEMETRY;
}
