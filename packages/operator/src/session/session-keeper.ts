/**
 * Keeps one media session with the wanted robot alive, without a socket, a peer connection or a clock. From the events
 * that it is told, it decides when to open a session, keep it, give it up and open another. A session lives on while
 * its peers hear each other, even if signaling is lost.
 */

import type { RobotEndReason, RobotListing } from '@farpoint/protocol';
import { Backoff } from '@farpoint/timing';
import { ResumePolicy } from './resume-policy.ts';
import { finalLosses, lossOf, type SessionLoss } from './session-loss.ts';

/** The phase of the session with the wanted robot. */
export type SessionPhase =
  /** No robot is wanted. */
  | 'none'
  /** The wanted robot or the signaling service is not available. */
  | 'waiting'
  /** Requested; the peer connection is not established yet. */
  | 'opening'
  /** The peer connection is established. */
  | 'live';

export interface SessionActions {
  requestSession(robotId: string): void;
  /** Ask the robot to restart ICE in the existing session. */
  resumeSession(session: string, robotId: string): void;
  /** Tell the service, to which the session may already be unknown. */
  closeSession(session: string): void;
  /** Close the peer connection, if there is one. */
  dropPeer(): void;
  onPhase(phase: SessionPhase): void;
  onLoss(loss: SessionLoss): void;
  /** Within a live session: the path is lost (`false`) or restored (`true`). */
  onPath(up: boolean): void;
}

/**
 * Time limit from the request to an established peer connection, ms. Chosen: the 8 s that a robot waits for a
 * slow relay (waiting-places.ts), and the ways of signaling.
 */
const OPEN_TIMEOUT_MS = 15_000;
/** Silence after which the session is given up, ms: the robot has given it up by then, too. */
const SILENCE_LIMIT_MS = 60_000;
/**
 * A robot that ends a session closes the connection and tells the service why. The reason may arrive later than the
 * end, so a connection that has ended waits this long for it, ms.
 */
const REASON_MS = 400;

export class SessionKeeper {
  readonly #actions: SessionActions;
  readonly #backoff: Backoff;
  #phase: SessionPhase = 'none';
  #robotId: string | null = null;
  #session: string | null = null;
  #signalingReady = false;
  #listed = false;
  #deadlineMs = Number.POSITIVE_INFINITY;
  #retryAtMs = 0;
  readonly #resume = new ResumePolicy();
  #pathUp = false;
  /** When the connection of a live session ended. */
  #failedAtMs: number | null = null;

  constructor(actions: SessionActions, random: () => number) {
    this.#actions = actions;
    this.#backoff = new Backoff({ firstMs: 500, mostMs: 5000, random });
  }

  get phase(): SessionPhase {
    return this.#phase;
  }
  get robotId(): string | null {
    return this.#robotId;
  }
  get session(): string | null {
    return this.#session;
  }
  /** Whether the wanted robot is in the service's list. */
  get robotListed(): boolean {
    return this.#listed;
  }

  /** Whether the peer connection is established, but nothing is received. */
  get interrupted(): boolean {
    return this.#phase === 'live' && !this.#pathUp;
  }

  want(robotId: string | null, robots: readonly RobotListing[], nowMs: number): void {
    if (robotId === this.#robotId) return;
    if (this.#phase === 'opening' || this.#phase === 'live') this.#endSession();
    this.#robotId = robotId;
    this.#retryAtMs = 0;
    this.#backoff.reset();
    this.#listed = robots.some((robot) => robot.id === robotId);
    this.#enter(robotId === null ? 'none' : 'waiting');
    this.update(nowMs);
  }

  onSignaling(ready: boolean, nowMs: number): void {
    if (ready === this.#signalingReady) return;
    this.#signalingReady = ready;
    if (!ready) {
      if (this.#phase === 'opening') this.#lose('signaling-lost', nowMs);
      return;
    }
    this.#resume.onSignalingBack();
    this.update(nowMs);
  }

  onRobots(robots: readonly RobotListing[], nowMs: number): void {
    const listed = robots.some((robot) => robot.id === this.#robotId);
    // The robot is back: an old failure must not delay the next attempt.
    if (listed && !this.#listed) {
      this.#retryAtMs = 0;
      this.#backoff.reset();
      this.#resume.onSignalingBack();
    }
    this.#listed = listed;
    this.update(nowMs);
  }

  /** The service opened a session. @returns false if it is not the requested one and must be closed */
  onOpened(session: string, robotId: string): boolean {
    if (this.#phase !== 'opening' || this.#session !== null || robotId !== this.#robotId) return false;
    this.#session = session;
    return true;
  }

  onClosed(session: string, reason: RobotEndReason, nowMs: number): void {
    if (session !== this.#session) return;
    // Only the robot's signaling is lost; the peers may still hear each other.
    if (reason === 'robot-left' && this.#phase === 'live') return;
    this.#lose(lossOf[reason], nowMs);
    // The robot has restarted and is available.
    if (reason === 'unknown-session') this.#retryAtMs = 0;
    this.update(nowMs);
  }

  /** The service refused a request. @param session the one that the service named, if any */
  onRefused(session: string | undefined, nowMs: number): void {
    if (this.#phase !== 'opening') return;
    if (session === undefined ? this.#session === null : session === this.#session) {
      this.#lose('refused', nowMs);
    }
  }

  onPeerConnected(nowMs: number): void {
    if (this.#phase !== 'opening') return;
    this.#resume.begin(nowMs);
    this.#pathUp = true;
    this.#deadlineMs = Number.POSITIVE_INFINITY;
    this.#enter('live');
  }

  /** A packet or message came from the robot. */
  onHeard(nowMs: number): void {
    this.#resume.onHeard(nowMs);
    if (this.#phase !== 'live') return;
    this.#backoff.reset();
    this.#notePath(nowMs);
  }

  /** The robot answered a clock probe: it hears us. */
  onAnswered(nowMs: number): void {
    this.#resume.onAnswered(nowMs);
  }

  /** The browser's network has changed or is lost. */
  onNetworkChange(nowMs: number): void {
    this.#resume.onNetworkChange(nowMs);
    this.update(nowMs);
  }

  onPeerFailed(nowMs: number, loss: SessionLoss = 'connection-failed'): void {
    if (this.#phase === 'live' && this.#signalingReady && loss === 'connection-failed') {
      this.#failedAtMs ??= nowMs;
      if (this.#pathUp) this.#actions.onPath(false);
      this.#pathUp = false;
    } else if (this.#phase === 'opening' || this.#phase === 'live') this.#lose(loss, nowMs);
  }

  /** Tries again now, also after a loss that would otherwise be final. */
  retry(nowMs: number): void {
    if (this.#phase !== 'waiting') return;
    this.#retryAtMs = 0;
    this.update(nowMs);
  }

  /** Acts on every deadline that has passed. Call at least twice a second. */
  update(nowMs: number): void {
    if (this.#phase === 'opening' && nowMs >= this.#deadlineMs) this.#lose('not-connected', nowMs);
    if (this.#failedAtMs !== null) {
      // Without a reason, it was the connection.
      if (nowMs >= this.#failedAtMs + REASON_MS) this.#lose('connection-failed', this.#failedAtMs);
    } else if (this.#phase === 'live') {
      const canAsk = this.#signalingReady && this.#listed;
      const ask = this.#resume.decide(nowMs, canAsk);
      this.#notePath(nowMs);
      if (this.#resume.silentMs(nowMs) >= SILENCE_LIMIT_MS) this.#lose('silent', nowMs);
      else if (ask && this.#session !== null && this.#robotId !== null) {
        this.#actions.resumeSession(this.#session, this.#robotId);
      }
    }
    if (
      this.#phase === 'waiting' &&
      this.#robotId !== null &&
      this.#signalingReady &&
      this.#listed &&
      nowMs >= this.#retryAtMs
    ) {
      this.#deadlineMs = nowMs + OPEN_TIMEOUT_MS;
      this.#enter('opening');
      this.#actions.requestSession(this.#robotId);
    }
  }

  #notePath(nowMs: number): void {
    const up = !this.#resume.lost(nowMs);
    if (up === this.#pathUp) return;
    this.#pathUp = up;
    this.#actions.onPath(up);
  }

  #lose(loss: SessionLoss, nowMs: number): void {
    this.#endSession();
    this.#retryAtMs = finalLosses.has(loss) ? Number.POSITIVE_INFINITY : nowMs + this.#backoff.nextMs();
    this.#actions.onLoss(loss);
    // Somebody meant it: only the operator's own choice opens another session.
    if (loss === 'ended-by-supervisor') this.#robotId = null;
    this.#enter(this.#robotId === null ? 'none' : 'waiting');
  }

  #endSession(): void {
    if (this.#session !== null) this.#actions.closeSession(this.#session);
    this.#session = null;
    this.#failedAtMs = null;
    this.#deadlineMs = Number.POSITIVE_INFINITY;
    this.#actions.dropPeer();
  }

  #enter(phase: SessionPhase): void {
    if (phase === this.#phase) return;
    this.#phase = phase;
    this.#actions.onPhase(phase);
  }
}
