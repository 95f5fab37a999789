/**
 * Keeps one media session with the wanted robot alive, without a socket, a peer connection or a clock: told what happens,
 * it decides when to open, keep, give up and open again. A session lives on while its peers hear each other, whatever
 * becomes of signaling.
 */
import { Backoff } from '@farpoint/congestion';
import type { RobotListing } from '@farpoint/protocol';

export type SessionPhase =
  | 'none' // no robot is wanted
  | 'waiting' // the wanted robot, or the signaling service, is not here
  | 'opening' // asked for, until the peer connection stands
  | 'live'; // the peer connection stands

/** Why a session was given up. */
export type SessionLoss =
  | 'not-connected' // no peer connection came about in time
  | 'connection-failed' // ICE or DTLS ended
  | 'closed-by-robot'
  | 'robot-restarted' // the robot registered anew while nothing was heard
  | 'silent' // nothing heard for long
  | 'signaling-lost' // before the peers had met
  | 'refused'; // the service would not open it

export interface SessionActions {
  requestSession(robotId: string): void;
  /** Tell the service; the session may already be unknown to it. */
  closeSession(session: string): void;
  /** Close the peer connection, if there is one. */
  dropPeer(): void;
  onPhase(phase: SessionPhase): void;
  onLoss(loss: SessionLoss): void;
}

/** From the request to a peer connection. */
const OPEN_TIMEOUT_MS = 15_000;
/** A robot that was away and is back must have been silent for so long before its old session counts as dead. */
const SILENCE_AFTER_RETURN_MS = 1500;
/** Longer than any ICE consent timeout: then the connection's own state cannot be believed. */
const SILENCE_LIMIT_MS = 40_000;

export class SessionKeeper {
  readonly #actions: SessionActions;
  readonly #backoff: Backoff;
  #phase: SessionPhase = 'none';
  #robotId: string | null = null;
  #session: string | null = null;
  #signalingReady = false;
  #listed = false;
  /** The robot's registration ended at some time during this session. */
  #robotWasAway = false;
  #deadlineMs = Number.POSITIVE_INFINITY;
  #retryAtMs = 0;
  #lastHeardMs = 0;

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

  want(robotId: string | null, robots: readonly RobotListing[], nowMs: number): void {
    if (robotId === this.#robotId) return;
    if (this.#phase === 'opening' || this.#phase === 'live') this.#endSession();
    this.#robotId = robotId;
    this.#retryAtMs = 0;
    this.#backoff.reset();
    this.#listed = robots.some((robot) => robot.id === robotId);
    this.#enter(robotId === null ? 'none' : 'waiting');
    this.tick(nowMs);
  }

  onSignaling(ready: boolean, nowMs: number): void {
    if (ready === this.#signalingReady) return;
    this.#signalingReady = ready;
    if (!ready) {
      if (this.#phase === 'opening') this.#lose('signaling-lost', nowMs);
      return;
    }
    this.tick(nowMs);
  }

  onRobots(robots: readonly RobotListing[], nowMs: number): void {
    const listed = robots.some((robot) => robot.id === this.#robotId);
    if (!listed && this.#listed) this.#robotWasAway = true;
    // It is back: do not let an old failure delay it.
    if (listed && !this.#listed) {
      this.#retryAtMs = 0;
      this.#backoff.reset();
    }
    this.#listed = listed;
    this.tick(nowMs);
  }

  /** The service opened a session. @returns false where it is not the one we wait for: close it */
  onOpened(session: string, robotId: string): boolean {
    if (this.#phase !== 'opening' || this.#session !== null || robotId !== this.#robotId) return false;
    this.#session = session;
    return true;
  }

  onClosed(session: string, reason: 'robot-left' | 'closed-by-robot' | 'other', nowMs: number): void {
    if (session !== this.#session) return;
    // Only its signaling went; the peers may still hear each other.
    if (reason === 'robot-left' && this.#phase === 'live') {
      this.#robotWasAway = true;
      return;
    }
    this.#lose('closed-by-robot', nowMs);
  }

  /** The service refused a request of ours. `session` where it named one. */
  onRefused(session: string | undefined, nowMs: number): void {
    if (this.#phase !== 'opening') return;
    if (session === undefined ? this.#session === null : session === this.#session) {
      this.#lose('refused', nowMs);
    }
  }

  onPeerConnected(nowMs: number): void {
    if (this.#phase !== 'opening') return;
    this.#lastHeardMs = nowMs;
    this.#robotWasAway = false;
    this.#deadlineMs = Number.POSITIVE_INFINITY;
    this.#enter('live');
  }

  /** Any packet or message of the robot. */
  onHeard(nowMs: number): void {
    this.#lastHeardMs = nowMs;
    if (this.#phase === 'live') this.#backoff.reset();
  }

  onPeerFailed(nowMs: number): void {
    if (this.#phase === 'opening' || this.#phase === 'live') this.#lose('connection-failed', nowMs);
  }

  /** Call at least twice a second. */
  tick(nowMs: number): void {
    if (this.#phase === 'opening' && nowMs >= this.#deadlineMs) this.#lose('not-connected', nowMs);
    if (this.#phase === 'live') {
      const silentMs = nowMs - this.#lastHeardMs;
      if (this.#robotWasAway && this.#listed && silentMs >= SILENCE_AFTER_RETURN_MS) {
        this.#lose('robot-restarted', nowMs);
        this.#retryAtMs = 0;
      } else if (silentMs >= SILENCE_LIMIT_MS) {
        this.#lose('silent', nowMs);
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
      this.#robotWasAway = false;
      this.#enter('opening');
      this.#actions.requestSession(this.#robotId);
    }
  }

  #lose(loss: SessionLoss, nowMs: number): void {
    this.#endSession();
    this.#retryAtMs = nowMs + this.#backoff.nextMs();
    this.#actions.onLoss(loss);
    this.#enter('waiting');
  }

  #endSession(): void {
    if (this.#session !== null) this.#actions.closeSession(this.#session);
    this.#session = null;
    this.#deadlineMs = Number.POSITIVE_INFINITY;
    this.#actions.dropPeer();
  }

  #enter(phase: SessionPhase): void {
    if (phase === this.#phase) return;
    this.#phase = phase;
    this.#actions.onPhase(phase);
  }
}
