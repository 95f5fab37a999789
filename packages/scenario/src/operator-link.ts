import type { RobotLink, RobotLinkEvents, SessionLoss, SessionPhase } from '@farpoint/operator';
import { RobotSession as HeardSession, SessionKeeper } from '@farpoint/operator/testing/link-parts';
import {
  type Command,
  encodeJson,
  type OperatorControlMessage,
  type OperatorSessionMessage,
  operatorControlCodec,
  operatorSessionCodec,
  type RobotEndReason,
  type RobotListing,
} from '@farpoint/protocol';
import type { Access } from '@farpoint/robot-node/testing/drive-core';
import { Connection, type SentFrame } from './connection.ts';
import type { Direction } from './direction.ts';
import type { ScenarioRobot } from './robot.ts';
import type { RobotSession } from './robot-session.ts';
import type { Signaling } from './signaling.ts';

const [TICK_MS, PROBE_MS] = [250, 500];

export interface OperatorLinkParts {
  name: string;
  /** What its grant lets it do; `null`: the robot asks for none. */
  access: Access | null;
  robot: ScenarioRobot;
  signaling: Signaling;
  up: Direction;
  down: Direction;
  random: () => number;
  /** What becomes of each command before it is sent; `null`: nothing is. */
  alter: (command: Command) => Command | string | null;
  onFrame: (frame: SentFrame) => void;
}

/** The operator's link to a robot in virtual time, with the real session keeper. */
export class OperatorLink implements RobotLink {
  sessionsOpened = 0;
  lastLoss: SessionLoss | null = null;
  lossDetail: string | null = null;
  readonly signInUrl = null;
  readonly changedRobotKey = null;
  readonly maxOperators = null;
  readonly #parts: OperatorLinkParts;
  readonly #events: RobotLinkEvents;
  readonly #keeper: SessionKeeper;
  #timer: ReturnType<typeof setInterval> | undefined;
  #session: HeardSession;
  #connection: Connection | null = null;
  #generation = 0;
  #lastHeardMs = 0;
  #probeDueMs = 0;
  #gone = false;

  constructor(parts: OperatorLinkParts, events: RobotLinkEvents) {
    [this.#parts, this.#events] = [parts, events];
    this.#session = new HeardSession(events);
    const { signaling, robot } = parts;
    this.#keeper = new SessionKeeper(
      {
        requestSession: () => signaling.post(() => this.#open()),
        resumeSession: (id) => {
          const key = this.#session.welcome?.resumeKey;
          if (key === undefined) return;
          const request = { type: 'session.resume', session: id, operator: parts.name, claim: 'c' } as const;
          signaling.post(() => void robot.core.paths.resume({ ...request, resumeKey: key }, []));
        },
        closeSession: (id) => signaling.post(() => robot.closed(id)),
        dropPeer: () => this.#drop(),
        onPhase: (phase) => {
          if (phase === 'live') this.sessionsOpened++;
          events.onPhase(phase);
        },
        onLoss: (loss) => {
          this.lastLoss = loss;
          events.onLoss(loss);
        },
        onPath: (up) => events.onPath(up),
      },
      parts.random,
    );
    signaling.onReady((ready) => {
      this.#keeper.onSignaling(ready, performance.now());
      events.onSignaling(this.signaling);
    });
  }

  start(): void {
    this.#keeper.onSignaling(true, performance.now());
    this.#keeper.onRobots(this.robots, performance.now());
    this.#timer = setInterval(() => this.#tick(performance.now()), TICK_MS);
  }

  close(): void {
    clearInterval(this.#timer);
    this.disconnect();
  }

  /** The machine loses its power: nothing is said. */
  vanish(): void {
    this.#gone = true;
    clearInterval(this.#timer);
    this.#connection?.vanish();
  }

  /** The connection is closed by the operator's side. */
  drop(): void {
    this.#connection?.close('operator');
  }

  /** The network gives this side other addresses. */
  renumber(): void {
    this.#connection?.renumber();
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
  get signaling(): 'ready' | 'waiting' {
    return this.#parts.signaling.ready ? 'ready' : 'waiting';
  }
  get robots(): readonly RobotListing[] {
    return [{ id: this.#parts.robot.id, name: 'Robot' }];
  }
  get robotId(): string | null {
    return this.#keeper.robotId;
  }
  get robotListed(): boolean {
    return this.#keeper.robotListed;
  }
  get session(): HeardSession {
    return this.#session;
  }
  get interrupted(): boolean {
    return this.#keeper.interrupted;
  }
  silentMs(nowMs: number): number {
    return nowMs - this.#lastHeardMs;
  }

  sendCommand(command: Command): void {
    if (this.interrupted) return;
    const altered = this.#parts.alter(command);
    if (typeof altered === 'string') this.sendText(altered);
    else if (altered !== null) this.sendControl(altered);
  }

  sendControl(message: OperatorControlMessage): void {
    this.sendText(encodeJson(operatorControlCodec, message));
  }

  /** Sends this on the control channel, whatever it is. */
  sendText(text: string): void {
    if (!this.#gone) this.#connection?.controlToRobot(text);
  }

  sendSession(message: OperatorSessionMessage): void {
    if (!this.#gone) this.#connection?.sessionToRobot(encodeJson(operatorSessionCodec, message));
  }

  limitBandwidth(): void {}
  sendReport(): void {}

  onPoints(nowMs: number): void {
    this.#heard(nowMs);
  }

  /** The robot has answered the request for a session. */
  #open(): void {
    const { robot, name, access, signaling, up, down } = this.#parts;
    const session = robot.open(name, access);
    session.onEndTold = (end) => {
      this.#keeper.onClosed(session.id, end as RobotEndReason, performance.now());
    };
    signaling.post(() => {
      if (this.#gone || !this.#keeper.onOpened(session.id, robot.id)) {
        signaling.post(() => session.end('closed', 'nobody wants it'));
        return;
      }
      this.#begin(session, up, down);
    });
  }

  #begin(session: RobotSession, up: Direction, down: Direction): void {
    this.#drop();
    this.#generation++;
    this.#session = new HeardSession(this.#events);
    this.#events.onGeneration(this.#generation);
    const connection: Connection = new Connection(up, down, {
      robot: this.#parts.robot.endOf(session),
      operator: {
        onConnected: () => {
          this.#heard(performance.now());
          this.#keeper.onPeerConnected(performance.now());
        },
        onMessage: (channel, text) => {
          if (connection !== this.#connection || this.#gone) return;
          const nowMs = performance.now();
          this.#heard(nowMs);
          if (channel === 'control') this.#keeper.onAnswered(nowMs);
          this.#session.onMessage(channel, text, nowMs);
        },
        onFrame: (frame) => {
          if (connection !== this.#connection || this.#gone) return;
          this.#heard(performance.now());
          this.#parts.onFrame(frame);
        },
        onFailed: () => {
          if (connection === this.#connection) this.#keeper.onPeerFailed(performance.now());
        },
      },
    });
    this.#connection = connection;
    session.use(connection);
    connection.begin();
  }

  /** A new path is offered, and answered. */
  restarted(session: RobotSession): void {
    if (session.connection !== this.#connection) return;
    this.#connection?.restored();
    this.#parts.signaling.post(() => session.restarts.onAnswer());
  }

  #drop(): void {
    this.#connection?.close('operator');
    this.#connection = null;
  }

  #heard(nowMs: number): void {
    this.#lastHeardMs = nowMs;
    this.#keeper.onHeard(nowMs);
  }

  #tick(nowMs: number): void {
    this.#keeper.tick(nowMs);
    if (this.#keeper.phase === 'live' && nowMs >= this.#probeDueMs) {
      this.#probeDueMs = nowMs + PROBE_MS;
      this.sendControl({ type: 'clockProbe', id: this.#session.nextProbeId(), sentMs: nowMs });
    }
  }
}
