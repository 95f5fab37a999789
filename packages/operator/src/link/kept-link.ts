/**
 * A link whose session a {@link SessionKeeper} keeps: what all such links know of their session, and their clock probes. A
 * subclass carries the messages, and tells what comes.
 */
import type {
  Command,
  MessageData,
  OperatorControlMessage,
  OperatorSessionMessage,
  RobotListing,
} from '@farpoint/protocol';
import type { ChangedRobotKey } from '../access/session-admission.ts';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import { type RobotChannel, RobotSession } from '../session/robot-session.ts';
import { SessionKeeper, type SessionPhase } from '../session/session-keeper.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import type { RobotLink, RobotLinkEvents, SignalingState } from './robot-link.ts';

/**
 * How often silence is looked for, ms: a quarter of the time after which a path is lost; and how often the
 * robot's clock is asked for: five times before it counts as unanswered (resume-policy.ts).
 */
const [UPDATE_EVERY_MS, PROBE_MS] = [250, 500];

export abstract class KeptLink implements RobotLink {
  robots: readonly RobotListing[] = [];
  session: RobotSession;
  sessionsOpened = 0;
  lastLoss: SessionLoss | null = null;
  lossDetail: string | null = null;
  changedRobotKey: ChangedRobotKey | null = null;
  maxOperators: number | null = null;
  abstract readonly signaling: SignalingState;
  abstract readonly signInUrl: string | null;
  abstract readonly statusFeed: RobotLink['statusFeed'];
  protected readonly events: RobotLinkEvents;
  protected readonly keeper: SessionKeeper;
  /** Number of the session, for the worker's batches. */
  protected generation = 0;
  #lastHeardMs = 0;
  #probeDueMs = 0;
  #timer: ReturnType<typeof setInterval> | undefined;

  /** @param random evenly distributed, 0–1: how long to wait before the next attempt */
  constructor(events: RobotLinkEvents, random: () => number) {
    this.events = events;
    this.session = new RobotSession(events);
    this.keeper = new SessionKeeper(
      {
        requestSession: (robotId) => this.requestSession(robotId),
        resumeSession: (session, robotId) => this.resumeSession(session, robotId),
        closeSession: (session) => this.closeSession(session),
        dropPeer: () => this.dropPeer(),
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
      random,
    );
  }

  abstract sendControl(message: OperatorControlMessage): void;
  abstract sendSession(message: OperatorSessionMessage): void;
  abstract limitBandwidth(bitsPerSecond: number): void;
  abstract sendReport(report: IntakeReport): void;
  // What the session's keeper asks for: see SessionActions.
  protected abstract requestSession(robotId: string): void;
  protected abstract resumeSession(session: string, robotId: string): void;
  protected abstract closeSession(session: string): void;
  protected abstract dropPeer(): void;

  start(): void {
    this.#timer ??= setInterval(() => this.#update(performance.now()), UPDATE_EVERY_MS);
  }

  close(): void {
    this.stopUpdating();
    this.disconnect();
  }

  connect(robotId: string): void {
    this.keeper.want(robotId, this.robots, performance.now());
  }

  retry(): void {
    this.keeper.retry(performance.now());
  }

  disconnect(): void {
    this.keeper.want(null, this.robots, performance.now());
  }

  get phase(): SessionPhase {
    return this.keeper.phase;
  }
  get robotId(): string | null {
    return this.keeper.robotId;
  }
  get robotListed(): boolean {
    return this.keeper.robotListed;
  }
  get interrupted(): boolean {
    return this.keeper.interrupted;
  }
  silentMs(nowMs: number): number {
    return nowMs - this.#lastHeardMs;
  }

  /** Skipped while the path is lost: a command would not arrive, but would keep later ones waiting. */
  sendCommand(command: Command): void {
    if (!this.interrupted) this.sendControl(command);
  }

  onPoints(nowMs: number): void {
    this.heard(nowMs);
  }

  protected stopUpdating(): void {
    clearInterval(this.#timer);
    this.#timer = undefined;
  }

  /** The connection to the service is in this state now. */
  protected onSignalingState(state: SignalingState): void {
    this.keeper.onSignaling(state === 'ready', performance.now());
    this.events.onSignaling(state);
  }

  /** The service lists these robots now. */
  protected onListed(robots: readonly RobotListing[]): void {
    this.robots = robots;
    this.keeper.onRobots(robots, performance.now());
    this.events.onRobots(robots);
  }

  /** The requested session is there; its peer connection is set up next. */
  protected beginSession(): void {
    this.generation++;
    this.session = new RobotSession(this.events);
    this.events.onGeneration(this.generation);
  }

  /** The session's peer connection is established. */
  protected onPeerConnected(): void {
    const nowMs = performance.now();
    this.heard(nowMs);
    this.keeper.onPeerConnected(nowMs);
  }

  /** Data have come from the robot. */
  protected onMessage(channel: RobotChannel, data: MessageData): void {
    const nowMs = performance.now();
    this.heard(nowMs);
    // On this channel the robot sends answers to clock probes and STOP.
    if (channel === 'control') this.keeper.onAnswered(nowMs);
    this.session.onMessage(channel, data, nowMs);
  }

  /** Something has come from the robot. */
  protected heard(nowMs: number): void {
    this.#lastHeardMs = nowMs;
    this.keeper.onHeard(nowMs);
  }

  #update(nowMs: number): void {
    this.keeper.update(nowMs);
    if (this.phase !== 'live' || nowMs < this.#probeDueMs) return;
    this.#probeDueMs = nowMs + PROBE_MS;
    this.sendControl({ type: 'clockProbe', id: this.session.nextProbeId(), sentMs: nowMs });
  }
}
