import {
  type HostedOperator,
  type KeptOperator,
  OperatorMessages,
  type PeerEnd,
  RestartPolicy,
  ResumeKey,
  type SessionHost,
} from '@farpoint/robot-node/testing/drive-core';
import type { Connection, SentFrame } from './connection.ts';
import type { CaptureStations } from './slow-robot.ts';

/** A cloud as a poor link carries it: one packet. */
const FRAME_BYTES = 1200;

export interface RobotSessionParts {
  host: SessionHost;
  ended: (session: RobotSession, end: PeerEnd, detail: string) => void;
  connected: (session: RobotSession) => void;
}

/** The robot's end of an operator's session, with the real interpreter of its messages. */
export class RobotSession implements KeptOperator, HostedOperator {
  readonly messages: OperatorMessages;
  readonly restarts = new RestartPolicy();
  readonly resumeKey = new ResumeKey();
  /** Nothing is drawn green here. */
  readonly askLatencyTest = () => false;
  readonly videos: HostedOperator['videos'] = { lines: [] } as unknown as HostedOperator['videos'];
  readonly peer: KeptOperator['peer'] & { connected: boolean };
  /** What `null` says of the robot's: there is no path yet. */
  sender: object | null = null;
  quiet = false;
  /** The operator is told by the service why the session has ended. */
  onEndTold: ((end: PeerEnd, detail: string) => void) | null = null;
  readonly #parts: RobotSessionParts;
  #connection: Connection | null = null;
  #checkedMs = 0;
  #ended = false;

  constructor(id: string, name: string, parts: RobotSessionParts) {
    this.#parts = parts;
    this.peer = {
      connected: false,
      close: (end = 'closed', detail = '') => this.end(end, detail),
      restart: async () => 'v=0',
      useIceServers: () => undefined,
    };
    this.messages = new OperatorMessages(id, name, parts.host, {
      sendSession: (text) => this.#connection?.sessionToOperator(text),
      sendControl: (text) => this.#connection?.toOperator('control', text),
    });
  }

  get id(): string {
    return this.messages.id;
  }

  get heardMs(): number {
    return Math.max(this.messages.heardMs, this.#checkedMs);
  }

  get connection(): Connection | null {
    return this.#connection;
  }

  /** The connection that is being set up. */
  use(connection: Connection): void {
    this.#connection = connection;
  }

  connected(): void {
    this.peer.connected = true;
    this.sender = {};
    this.messages.heardMs = this.#parts.host.now();
    this.#parts.connected(this);
  }

  /** A connectivity check came. */
  heard(): void {
    this.#checkedMs = this.#parts.host.now();
  }

  /** A captured frame leaves for the operator. */
  frame(frame: SentFrame, stations: Readonly<CaptureStations>): void {
    if (!this.peer.connected || !this.messages.wishes.streaming || this.quiet) return;
    const { guard } = this.#parts.host.drive;
    guard.sentViews.sent(this.id, stations.capturedAtMs, 0);
    this.#connection?.frame(frame, FRAME_BYTES);
    const leftMs = this.#parts.host.now();
    this.messages.stages.frame(0, frame.number, { ...stations, firstLeftMs: leftMs, lastLeftMs: leftMs });
    guard.onViewSent(this.id, leftMs);
  }

  telemetry(text: string): void {
    this.#connection?.toOperator('telemetry', text);
  }

  update(): void {
    this.messages.flushRejections();
  }

  end(end: PeerEnd, detail: string): void {
    if (this.#ended) return;
    this.#ended = true;
    this.peer.connected = false;
    this.sender = null;
    this.#connection?.close('robot');
    this.#parts.ended(this, end, detail);
  }
}
