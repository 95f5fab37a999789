/** The page's link through a bridge: combines the bridge's sockets and {@link BridgeSession}. */
import type { Command, OperatorSessionMessage, RobotListing } from '@farpoint/protocol';
import type { ToCloudWorker } from '../cloud/worker-messages.ts';
import type { RobotLink, RobotLinkEvents, SignalingState } from '../link/robot-link.ts';
import { RobotSession } from '../session/robot-session.ts';
import type { SessionPhase } from '../session/session-keeper.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import { noStatusFeed } from '../signaling/status-feed.ts';
import { BridgeSession, type BridgeSessionActions } from './bridge-session.ts';
import type { BridgeAddress } from './bridge-settings.ts';
import { BridgeSocket } from './bridge-socket.ts';

/**
 * How often the bridge's silence is looked for, ms: a tenth of the time after which the page stops driving.
 */
const CHECK_EVERY_MS = 100;

export class BridgeLink implements RobotLink {
  sessionsOpened = 0;
  readonly lastLoss: SessionLoss | null = null;
  readonly lossDetail = null;
  readonly signInUrl = null;
  readonly statusFeed = noStatusFeed;
  readonly changedRobotKey = null;
  readonly maxOperators = null;
  readonly #address: BridgeAddress;
  readonly #worker: Worker;
  readonly #events: RobotLinkEvents;
  readonly #control: BridgeSocket;
  readonly #telemetry: BridgeSocket;
  readonly #bridge: BridgeSession;
  #session: RobotSession;
  #generation = 0;
  #timer: ReturnType<typeof setInterval> | undefined;

  constructor(address: BridgeAddress, worker: Worker, events: RobotLinkEvents) {
    this.#address = address;
    this.#worker = worker;
    this.#events = events;
    this.#session = new RobotSession(events);
    const onState = () => {
      this.#bridge.onSockets(this.#control.open && this.#telemetry.open);
      events.onSignaling(this.signaling);
    };
    this.#control = new BridgeSocket(address.control, {
      onState,
      onText: (text) => this.#bridge.onControl(text, performance.now()),
    });
    this.#telemetry = new BridgeSocket(address.telemetry, { onState, onText: () => undefined });
    const actions: BridgeSessionActions = {
      sendControl: (text) => this.#control.send(text),
      sendTelemetry: (text) => this.#telemetry.send(text),
      onRobots: (robots) => events.onRobots(robots),
      onPhase: (phase) => {
        if (phase === 'live') this.sessionsOpened++;
        events.onPhase(phase);
      },
      onBegin: () => this.#begin(),
      onRobotMessage: (text) => this.#session.onMessage('session', text, performance.now()),
      onPath: (up) => events.onPath(up),
    };
    this.#bridge = new BridgeSession(actions, address.signaling);
  }

  start(): void {
    this.#control.start();
    this.#telemetry.start();
    this.#timer = setInterval(() => this.#bridge.checkSilence(performance.now()), CHECK_EVERY_MS);
  }

  close(): void {
    this.disconnect();
    clearInterval(this.#timer);
    this.#control.close();
    this.#telemetry.close();
  }

  connect(robotId: string): void {
    this.#bridge.want(robotId);
  }

  /** A bridge tries by itself. */
  retry(): void {}

  disconnect(): void {
    this.#bridge.want(null);
  }

  get phase(): SessionPhase {
    return this.#bridge.phase;
  }
  get signaling(): SignalingState {
    return this.#control.open && this.#telemetry.open ? 'ready' : 'waiting';
  }
  get robots(): readonly RobotListing[] {
    return this.#bridge.robots;
  }
  get robotId(): string | null {
    return this.#bridge.robotId;
  }
  get robotListed(): boolean {
    return this.#bridge.robotListed;
  }
  get session(): RobotSession {
    return this.#session;
  }
  get interrupted(): boolean {
    return this.#bridge.interrupted;
  }
  silentMs(nowMs: number): number {
    return this.#bridge.silentMs(nowMs);
  }

  sendCommand(command: Command): void {
    this.#bridge.command(command, performance.now());
  }

  sendControl(): void {}

  sendSession(message: OperatorSessionMessage): void {
    this.#bridge.session(message);
  }

  /** Does nothing: the bridge itself reports to the robot. */
  limitBandwidth(): void {}

  onPoints(nowMs: number): void {
    this.#bridge.onPoints(nowMs);
  }

  sendReport(): void {}

  #begin(): void {
    this.#generation++;
    this.#session = new RobotSession(this.#events);
    this.#events.onGeneration(this.#generation);
    const message: ToCloudWorker = {
      type: 'bridge',
      url: this.#address.streaming,
      generation: this.#generation,
    };
    this.#worker.postMessage(message);
  }
}
