/** The direct link to a robot: combines signaling, the session keeper and the peer connection. */
import {
  encodeBandwidth,
  encodeJson,
  nextSequence32,
  type OperatorControlMessage,
  type OperatorSessionMessage,
  operatorControlCodec,
  operatorSessionCodec,
} from '@farpoint/protocol';
import type { StrangeRobotError } from '../access/session-admission.ts';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import { OperatorSignaling, type SessionSignal } from '../signaling/operator-signaling.ts';
import type { StatusFeed } from '../signaling/status-feed.ts';
import { WebSocketPort } from '../signaling/web-socket-port.ts';
import { IntroducedPeer, type LinkPeer, type OpenPeer } from './introduced-peer.ts';
import { KeptLink } from './kept-link.ts';
import { watchPageLifecycle } from './page-lifecycle.ts';
import type { RobotLinkEvents, SignalingState } from './robot-link.ts';
import type { WebRtcLinkOptions } from './webrtc-link-options.ts';

export class WebRtcLink extends KeptLink {
  readonly #options: WebRtcLinkOptions;
  readonly #signaling: OperatorSignaling;
  readonly #makePeer: OpenPeer;
  #peer: LinkPeer | null = null;
  readonly #closed = new AbortController();
  #reportSequence = 0;
  /** The robot to reconnect to when the page is restored from the browser's cache. */
  #left: string | null = null;

  /** @param openPeer default: over the browser's WebRTC */
  constructor(
    options: WebRtcLinkOptions,
    events: RobotLinkEvents,
    openPeer: OpenPeer = (...given) => new IntroducedPeer(...given),
  ) {
    super(events, Math.random);
    this.#options = options;
    this.#makePeer = openPeer;
    this.#signaling = new OperatorSignaling(
      options,
      new WebSocketPort(options.signalingUrl, () => this.#signaling),
      {
        onState: (state) => this.onSignalingState(state),
        onRobots: (robots) => this.onListed(robots),
        onSession: (message) => this.#onSignal(message),
        onFault: (error) => console.warn('signaling:', error.message),
      },
      Math.random,
    );
  }

  override start(): void {
    this.#signaling.start();
    super.start();
    const { signal } = this.#closed;
    watchNetwork((online) => {
      // Retry now whatever is waiting for its next attempt.
      if (online) this.#signaling.retryNow();
      this.keeper.onNetworkChange(performance.now());
    }, signal);
    const page = { onLeave: () => this.#leave(), onReturn: () => this.#return() };
    watchPageLifecycle(window, page, signal);
  }

  override close(): void {
    this.#closed.abort();
    super.close();
    this.#signaling.stop();
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

  get signaling(): SignalingState {
    return this.#signaling.state;
  }
  get statusFeed(): StatusFeed {
    return this.#signaling;
  }
  get signInUrl(): string | null {
    return this.#signaling.signInUrl;
  }

  sendSession(message: OperatorSessionMessage): void {
    this.#peer?.sendSession(encodeJson(operatorSessionCodec, message));
  }

  limitBandwidth(bitsPerSecond: number): void {
    this.#peer?.sendBandwidth(encodeBandwidth(bitsPerSecond) as Uint8Array<ArrayBuffer>);
  }

  sendReport(report: IntakeReport): void {
    if (report.generation !== this.generation || this.interrupted) return;
    this.#reportSequence = nextSequence32(this.#reportSequence);
    const { packetsReceived, packetsLost, bytesReceived } = report;
    const counts = { packetsReceived, packetsLost, bytesReceived };
    this.sendControl({ type: 'receiverReport', sequence: this.#reportSequence, ...counts });
  }

  sendControl(message: OperatorControlMessage): void {
    this.#peer?.sendControl(encodeJson(operatorControlCodec, message));
  }

  protected requestSession(robotId: string): void {
    this.#signaling.send({ type: 'session.open', robotId });
  }

  protected resumeSession(session: string, robotId: string): void {
    const resumeKey = this.session.welcome?.resumeKey;
    // The path was lost before the robot's welcome, or the robot cannot resume sessions.
    if (resumeKey === undefined) {
      this.keeper.onPeerFailed(performance.now());
      return;
    }
    this.#signaling.ask({ type: 'session.resume', session, robotId, resumeKey });
  }

  protected closeSession(session: string): void {
    this.#signaling.send({ type: 'session.close', session });
  }

  protected dropPeer(): void {
    this.#peer?.close();
    this.#peer = null;
  }

  #onSignal(message: SessionSignal): void {
    const nowMs = performance.now();
    switch (message.type) {
      case 'session.opened': {
        // The robot has accepted the request for a new path; its offer follows.
        if (message.session === this.keeper.session) return;
        const ours = this.keeper.onOpened(message.session, message.robotId);
        if (ours) this.#openPeer(message.session);
        else this.#signaling.send({ type: 'session.close', session: message.session });
        return;
      }
      case 'session.offer':
        if (message.session !== this.keeper.session) return;
        this.#peer?.useIceServers(this.#signaling.iceServers, this.#options.icePolicy);
        this.#peer?.offer(message);
        return;
      case 'session.candidate':
        if (message.session === this.keeper.session) void this.#peer?.candidate(message.candidate);
        return;
      case 'session.closed': {
        const { session, reason, maxOperators = null, detail = null } = message;
        if (detail !== null) console.warn('session ended by the robot:', reason, detail);
        if (session === this.keeper.session) this.lossDetail = detail;
        if (reason === 'robot-full') this.maxOperators = maxOperators;
        this.keeper.onClosed(session, reason, nowMs);
        return;
      }
      case 'error':
        // An established session does not need the service, so it may be unknown there, or the robot away.
        if (message.code !== 'unknown-session' && !(this.phase === 'live' && message.session !== undefined))
          this.events.onRefusal(message.message);
        this.keeper.onRefused(message.session, nowMs);
    }
  }

  #openPeer(session: string): void {
    this.dropPeer();
    this.#reportSequence = 0;
    this.beginSession();
    const peer: LinkPeer = this.#makePeer(
      {
        session,
        robotId: this.keeper.robotId ?? '',
        generation: this.generation,
        link: this.#options,
        iceServers: this.#signaling.iceServers,
      },
      {
        send: (message) => this.#signaling.send(message),
        onStranger: (error) => this.#onStranger(error),
        onConnected: () => this.onPeerConnected(),
        onMessage: (channel, data) => {
          if (peer === this.#peer) this.onMessage(channel, data);
        },
        onVideoTrack: (track) => this.events.onVideoTrack(track),
        onSoundLine: (line) => this.events.onSoundLine(line),
        onFailed: (detail) => {
          if (peer !== this.#peer) return;
          console.warn('peer:', detail);
          this.keeper.onPeerFailed(performance.now());
        },
      },
    );
    this.#peer = peer;
  }

  /** Somebody other than the robot has sent an offer. It ends an attempt to connect, but never a running session. */
  #onStranger({ reason, message, changed }: StrangeRobotError): void {
    console.warn('an offer that is not the robot’s:', message);
    if (this.phase === 'live') return;
    this.lossDetail = message;
    this.changedRobotKey = changed;
    this.keeper.onPeerFailed(performance.now(), reason);
  }
}

/** Reports, until `signal` is aborted, when the browser's network changes or is lost. */
function watchNetwork(onChange: (online: boolean) => void, signal: AbortSignal): void {
  const changed = () => onChange(navigator.onLine);
  window.addEventListener('online', changed, { signal });
  window.addEventListener('offline', changed, { signal });
  // Missing in some browsers, and in TypeScript's types.
  (navigator as { connection?: EventTarget }).connection?.addEventListener('change', changed, { signal });
}
