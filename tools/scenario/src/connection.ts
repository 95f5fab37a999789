import type { RobotChannel } from '@farpoint/operator/testing/link-parts';
import type { Direction } from './direction.ts';
import { ReliableChannel } from './reliable-channel.ts';

/** Of a datagram: RTP or SCTP, DTLS, UDP and IP. */
const HEADER_BYTES = 80;
const CHECK_MS = 2500;

/** What a robot sends of a captured frame. */
export interface SentFrame {
  number: number;
  /** Robot's monotonic clock, µs, modulo 2³². */
  captureUs: number;
}

/** The operator's end. */
export interface OperatorEnd {
  onConnected(): void;
  onMessage(channel: RobotChannel, text: string): void;
  onFrame(frame: SentFrame): void;
  /** The robot has ended the connection. */
  onFailed(): void;
}

/** The robot's end. */
export interface RobotEnd {
  onConnected(): void;
  onMessage(channel: 'session' | 'control', text: string): void;
  /** Something else came: a connectivity check. */
  onHeard(): void;
  /** The operator's end has closed the connection, or its control channel. */
  onLost(): void;
}

/**
 * A peer connection between an operator and the robot, over a link: set up by four messages, two each way, with channels as
 * WebRTC has them, and an end that is told to the other side by one datagram, which may be lost.
 */
export class Connection {
  readonly #up: Direction;
  readonly #down: Direction;
  readonly #session: { up: ReliableChannel; down: ReliableChannel };
  readonly #operator: OperatorEnd;
  readonly #robot: RobotEnd;
  readonly #checks: ReturnType<typeof setInterval>;
  #open = { operator: true, robot: true };
  /** Whether packets take no path, because the addresses of one side have changed. */
  #pathless = false;

  /** @param up from the robot to the operator @param down from the operator to the robot */
  constructor(up: Direction, down: Direction, ends: { operator: OperatorEnd; robot: RobotEnd }) {
    [this.#up, this.#down] = [up, down];
    [this.#operator, this.#robot] = [ends.operator, ends.robot];
    const toOperator = (text: string) => this.#operator.onMessage('session', text);
    this.#session = {
      up: this.#reliable('up', toOperator),
      down: this.#reliable('down', (text) => this.#robot.onMessage('session', text)),
    };
    this.#checks = setInterval(() => {
      this.#toRobot(HEADER_BYTES, () => this.#robot.onHeard());
    }, CHECK_MS);
  }

  /** ICE and DTLS. Lost messages are repeated. */
  begin(): void {
    const up: ReliableChannel = this.#reliable('up', (text) =>
      text === 'ready' ? this.#operator.onConnected() : down.send(text),
    );
    const down = this.#reliable('down', (text) => {
      if (text === 'hello') return up.send('keys');
      up.send('ready');
      this.#robot.onConnected();
    });
    up.send('hello');
  }

  sessionToOperator(text: string): void {
    if (this.#open.robot) this.#session.up.send(text);
  }

  sessionToRobot(text: string): void {
    if (this.#open.operator) this.#session.down.send(text);
  }

  /** Unordered, never repeated. */
  toOperator(channel: 'control' | 'telemetry', text: string): void {
    this.#toOperator(HEADER_BYTES + text.length, () => this.#operator.onMessage(channel, text));
  }

  /** Unordered, never repeated. */
  controlToRobot(text: string): void {
    this.#toRobot(HEADER_BYTES + text.length, () => this.#robot.onMessage('control', text));
  }

  frame(frame: SentFrame, bytes: number): void {
    this.#toOperator(bytes, () => this.#operator.onFrame(frame));
  }

  /** One end closes; the other is told. */
  close(end: 'operator' | 'robot'): void {
    if (!this.#open[end]) return;
    if (end === 'operator') this.#toRobot(HEADER_BYTES, () => this.#robot.onLost());
    else this.#toOperator(HEADER_BYTES, () => this.#operator.onFailed());
    this.#open[end] = false;
    clearInterval(this.#checks);
  }

  /** One end is gone without a word. */
  vanish(): void {
    this.#open.operator = false;
    clearInterval(this.#checks);
  }

  /** The addresses of the operator change: nothing gets through until {@link restored}. */
  renumber(): void {
    this.#pathless = true;
  }

  restored(): void {
    this.#pathless = false;
  }

  #reliable(direction: 'up' | 'down', deliver: (text: string) => void): ReliableChannel {
    const up = { send: (bytes: number, arrive: () => void) => this.#toOperator(bytes, arrive) };
    const down = { send: (bytes: number, arrive: () => void) => this.#toRobot(bytes, arrive) };
    const open = () => this.#open.operator && this.#open.robot;
    return direction === 'up'
      ? new ReliableChannel(up, down, deliver, open)
      : new ReliableChannel(down, up, deliver, open);
  }

  #toOperator(bytes: number, arrive: () => void): void {
    if (!this.#open.robot || this.#pathless) return;
    this.#up.send(bytes, () => {
      if (this.#open.operator && !this.#pathless) arrive();
    });
  }

  #toRobot(bytes: number, arrive: () => void): void {
    if (!this.#open.operator || this.#pathless) return;
    this.#down.send(bytes, () => {
      if (this.#open.robot && !this.#pathless) arrive();
    });
  }
}
