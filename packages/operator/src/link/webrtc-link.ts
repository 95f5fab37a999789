/** The direct link to a robot: combines signaling, the session keeper and the peer connection. */
import {
  type Command,
  encodeBandwidth,
  encodeJson,
  nextSequence32,
  type OperatorControlMessage,
  type OperatorSessionMessage,
  operatorControlCodec,
  operatorSessionCodec,
  type RobotListing,
} from '@farpoint/protocol';
import type { ChangedRobotKey, StrangeRobotError } from '../access/session-admission.ts';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import { RobotSession } from '../session/robot-session.ts';
import { SessionKeeper, type SessionPhase } from '../session/session-keeper.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import { OperatorSignaling, type SessionSignal } from '../signaling/operator-signaling.ts';
import type { SignalingState } from '../signaling/signaling-state.ts';
import { WebSocketPort } from '../signaling/web-socket-port.ts';
import { IntroducedPeer } from './introduced-peer.ts';
import { watchNetwork } from './network-changes.ts';
import { watchPageLifecycle } from './page-lifecycle.ts';
import type { RobotLink, RobotLinkEvents } from './robot-link.ts';
import type { WebRtcLinkOptions } from './webrtc-link-options.ts';

/** At first the robot's clock is asked at each tick. */
const [TICK_MS, PROBE_MS] = [100, 500];

export class WebRtcLink implements RobotLink {
  readonly #options: WebRtcLinkOptions;
  readonly #events: RobotLinkEvents;
  readonly #signaling: OperatorSignaling;
  readonly statusFeed: RobotLink['statusFeed'];
  readonly #keeper: SessionKeeper;
  #peer: IntroducedPeer | null = null;
  #generation = 0;
  readonly #closed = new AbortController();
  #session: RobotSession;
  #reportSequence = 0;
  #lastHeardMs = 0;
  #probeDueMs = 0;
  sessionsOpened = 0;
  /** Number of requests for an ICE restart. */
  resumesAsked = 0;
  lastLoss: SessionLoss | null = null;
  lossDetail: string | null = null;
  changedRobotKey: ChangedRobotKey | null = null;
  maxOperators: number | null = null;
  /** The robot to reconnect to when the page is restored from the browser's cache. */
  #left: string | null = null;

  constructor(options: WebRtcLinkOptions, events: RobotLinkEvents) {
    this.#options = options;
    this.#events = events;
    this.#session = new RobotSession(events);
    this.#signaling = new OperatorSignaling(
      options,
      new WebSocketPort(options.signalingUrl, () => this.#signaling),
      {
        onState: (state) => {
          this.#keeper.onSignaling(state === 'ready', performance.now());
          events.onSignaling(state);
        },
        onRobots: (robots) => {
          this.#keeper.onRobots(robots, performance.now());
          events.onRobots(robots);
        },
        onSession: (message) => this.#onSignal(message),
        onFault: (error) => console.warn('signaling:', error.message),
      },
      Math.random,
    );
    this.statusFeed = this.#signaling;
    this.#keeper = new SessionKeeper(
      {
        requestSession: (robotId) => this.#signaling.send({ type: 'session.open', robotId }),
        resumeSession: (session, robotId) => {
          const resumeKey = this.#session.welcome?.resumeKey;
          // The path was lost before the robot's welcome, or the robot cannot resume sessions.
          if (resumeKey === undefined) return this.#keeper.onPeerFailed(performance.now());
          this.resumesAsked++;
          this.#signaling.ask({ type: 'session.resume', session, robotId, resumeKey });
        },
        closeSession: (session) => this.#signaling.send({ type: 'session.close', session }),
        dropPeer: () => this.#dropPeer(),
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
      Math.random,
    );
  }

  start(): void {
    this.#signaling.start();
    const { signal } = this.#closed;
    const timer = setInterval(() => this.#tick(performance.now()), TICK_MS);
    signal.addEventListener('abort', () => clearInterval(timer));
    watchNetwork((online) => {
      if (online) this.#signaling.retryNow(); // whatever is waiting for its next attempt
      this.#keeper.onNetworkChange(performance.now());
    }, signal);
    const page = { onLeave: () => this.#leave(), onReturn: () => this.#return() };
    watchPageLifecycle(window, page, signal);
  }

  close(): void {
    this.#closed.abort();
    this.#leave();
  }

  /** Ends the session explicitly; otherwise the robot would keep it for a minute in case only its path was lost. */
  #leave(): void {
    this.#left = this.robotId;
    this.disconnect();
    this.#signaling.stop();
  }

  #return(): void {
    this.#signaling.start();
    if (this.#left !== null) this.connect(this.#left);
    this.#left = null;
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
  get signaling(): SignalingState {
    return this.#signaling.state;
  }
  get signInUrl(): string | null {
    return this.#signaling.signInUrl;
  }
  get robots(): readonly RobotListing[] {
    return this.#signaling.robots;
  }
  get robotId(): string | null {
    return this.#keeper.robotId;
  }
  get robotListed(): boolean {
    return this.#keeper.robotListed;
  }
  get session(): RobotSession {
    return this.#session;
  }
  get interrupted(): boolean {
    return this.#keeper.interrupted;
  }
  silentMs(nowMs: number): number {
    return nowMs - this.#lastHeardMs;
  }

  /** Skipped while the path is lost: a command would not arrive, but would keep later ones waiting. */
  sendCommand(command: Command): void {
    if (!this.interrupted) this.sendControl(command);
  }

  sendSession(message: OperatorSessionMessage): void {
    this.#peer?.sendSession(encodeJson(operatorSessionCodec, message));
  }

  limitBandwidth(bitsPerSecond: number): void {
    this.#peer?.sendBandwidth(encodeBandwidth(bitsPerSecond) as Uint8Array<ArrayBuffer>);
  }

  onPoints(nowMs: number): void {
    this.#heard(nowMs);
  }

  sendReport(report: IntakeReport): void {
    if (report.generation !== this.#generation || this.interrupted) return;
    this.#reportSequence = nextSequence32(this.#reportSequence);
    const { packetsReceived, packetsLost, bytesReceived } = report;
    const counts = { packetsReceived, packetsLost, bytesReceived };
    this.sendControl({ type: 'receiverReport', sequence: this.#reportSequence, ...counts });
  }

  sendControl(message: OperatorControlMessage): void {
    this.#peer?.sendControl(encodeJson(operatorControlCodec, message));
  }

  #onSignal(message: SessionSignal): void {
    const nowMs = performance.now();
    switch (message.type) {
      case 'session.opened': {
        // The robot has accepted the request for a new path; its offer follows.
        if (message.session === this.#keeper.session) return;
        const ours = this.#keeper.onOpened(message.session, message.robotId);
        if (ours) this.#openPeer(message.session);
        else this.#signaling.send({ type: 'session.close', session: message.session });
        return;
      }
      case 'session.offer':
        if (message.session !== this.#keeper.session) return;
        this.#peer?.useIceServers(this.#signaling.iceServers, this.#options.icePolicy);
        this.#peer?.offer(message);
        return;
      case 'session.candidate':
        if (message.session === this.#keeper.session) void this.#peer?.candidate(message.candidate);
        return;
      case 'session.closed': {
        const { session, reason, maxOperators = null, detail = null } = message;
        if (detail !== null) console.warn('session ended by the robot:', reason, detail);
        if (session === this.#keeper.session) this.lossDetail = detail;
        if (reason === 'robot-full') this.maxOperators = maxOperators;
        this.#keeper.onClosed(session, reason, nowMs);
        return;
      }
      case 'error':
        // An established session does not need the service, so it may be unknown there, or the robot away.
        if (message.code !== 'unknown-session' && !(this.phase === 'live' && message.session !== undefined))
          this.#events.onRefusal(message.message);
        this.#keeper.onRefused(message.session, nowMs);
    }
  }

  #openPeer(session: string): void {
    this.#dropPeer();
    this.#generation++;
    this.#reportSequence = 0;
    this.#session = new RobotSession(this.#events);
    this.#events.onGeneration(this.#generation);
    const peer: IntroducedPeer = new IntroducedPeer(
      {
        ...{ session, robotId: this.#keeper.robotId ?? '', generation: this.#generation },
        ...{ link: this.#options, iceServers: this.#signaling.iceServers },
      },
      {
        send: (message) => this.#signaling.send(message),
        onStranger: (error) => this.#onStranger(error),
        onConnected: () => {
          this.#heard(performance.now());
          this.#keeper.onPeerConnected(performance.now());
        },
        onMessage: (channel, data) => {
          if (peer !== this.#peer) return;
          const nowMs = performance.now();
          this.#heard(nowMs);
          // On this channel the robot sends answers to clock probes and STOP.
          if (channel === 'control') this.#keeper.onAnswered(nowMs);
          this.#session.onMessage(channel, data, nowMs);
        },
        onVideoTrack: (track) => this.#events.onVideoTrack(track),
        onSoundLine: (line) => this.#events.onSoundLine(line),
        onFailed: (detail) => {
          if (peer !== this.#peer) return;
          console.warn('peer:', detail);
          this.#keeper.onPeerFailed(performance.now());
        },
      },
    );
    this.#peer = peer;
  }

  #dropPeer(): void {
    this.#peer?.close();
    this.#peer = null;
  }

  /** Somebody other than the robot has sent an offer. It ends an attempt to connect, but never a running session. */
  #onStranger({ reason, message, changed }: StrangeRobotError): void {
    console.warn('an offer that is not the robot’s:', message);
    if (this.phase === 'live') return;
    [this.lossDetail, this.changedRobotKey] = [message, changed];
    this.#keeper.onPeerFailed(performance.now(), reason);
  }

  #heard(nowMs: number): void {
    this.#lastHeardMs = nowMs;
    this.#keeper.onHeard(nowMs);
  }

  #tick(nowMs: number): void {
    this.#keeper.tick(nowMs);
    if (this.#keeper.phase === 'live' && nowMs >= this.#probeDueMs) {
      this.#probeDueMs = nowMs + (this.#session.clock.settled ? PROBE_MS : TICK_MS);
      this.sendControl({ type: 'clockProbe', id: this.#session.nextProbeId(), sentMs: nowMs });
    }
  }
}
