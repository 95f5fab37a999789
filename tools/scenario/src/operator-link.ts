import type { RobotLinkEvents } from '@farpoint/operator';
import { KeptLink } from '@farpoint/operator/testing/link-parts';
import {
  type Command,
  encodeJson,
  type OperatorControlMessage,
  type OperatorSessionMessage,
  operatorControlCodec,
  operatorSessionCodec,
  type RobotEndReason,
} from '@farpoint/protocol';
import type { Access } from '@farpoint/robot-node/testing/drive-core';
import { Connection, type SentFrame } from './connection.ts';
import type { Direction } from './direction.ts';
import type { ScenarioRobot } from './robot.ts';
import type { RobotSession } from './robot-session.ts';
import type { Signaling } from './signaling.ts';

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
export class OperatorLink extends KeptLink {
  readonly signInUrl = null;
  readonly statusFeed = { statuses: new Map(), watchStatuses: () => {} };
  readonly #parts: OperatorLinkParts;
  #connection: Connection | null = null;
  #gone = false;

  constructor(parts: OperatorLinkParts, events: RobotLinkEvents) {
    super(events, parts.random);
    this.#parts = parts;
    this.robots = [{ id: parts.robot.id, name: 'Robot' }];
    parts.signaling.onReady(() => this.onSignalingState(this.signaling));
  }

  get signaling(): 'ready' | 'waiting' {
    return this.#parts.signaling.ready ? 'ready' : 'waiting';
  }

  override start(): void {
    this.keeper.onSignaling(true, performance.now());
    this.keeper.onRobots(this.robots, performance.now());
    super.start();
  }

  /** The machine loses its power: nothing is said. */
  vanish(): void {
    this.#gone = true;
    this.stopUpdating();
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

  override sendCommand(command: Command): void {
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

  protected requestSession(): void {
    this.#parts.signaling.post(() => this.#open());
  }

  protected resumeSession(id: string): void {
    const { name, signaling, robot } = this.#parts;
    const key = this.session.welcome?.resumeKey;
    if (key === undefined) return;
    const request = { type: 'session.resume', session: id, operator: name, claim: 'c' } as const;
    signaling.post(() => void robot.core.paths.resume({ ...request, resumeKey: key }, []));
  }

  protected closeSession(id: string): void {
    this.#parts.signaling.post(() => this.#parts.robot.closed(id));
  }

  protected dropPeer(): void {
    this.#connection?.close('operator');
    this.#connection = null;
  }

  /** The robot has answered the request for a session. */
  #open(): void {
    const { robot, name, access, signaling, up, down } = this.#parts;
    const session = robot.open(name, access);
    session.onEndTold = (end) => {
      this.keeper.onClosed(session.id, end as RobotEndReason, performance.now());
    };
    signaling.post(() => {
      if (this.#gone || !this.keeper.onOpened(session.id, robot.id)) {
        signaling.post(() => session.end('closed', 'nobody wants it'));
        return;
      }
      this.#begin(session, up, down);
    });
  }

  #begin(session: RobotSession, up: Direction, down: Direction): void {
    this.dropPeer();
    this.beginSession();
    const connection: Connection = new Connection(up, down, {
      robot: this.#parts.robot.endOf(session),
      operator: {
        onConnected: () => this.onPeerConnected(),
        onMessage: (channel, text) => {
          if (connection === this.#connection && !this.#gone) this.onMessage(channel, text);
        },
        onFrame: (frame) => {
          if (connection !== this.#connection || this.#gone) return;
          this.heard(performance.now());
          this.#parts.onFrame(frame);
        },
        onFailed: () => {
          if (connection === this.#connection) this.keeper.onPeerFailed(performance.now());
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
}
