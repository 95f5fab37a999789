/**
 * A link without a robot, a signaling service or a socket: a script says what the service and the robot do, by the real
 * codecs, and reads what the client sends. Phases, losses and retries are those of the direct link.
 */
import {
  decodeJson,
  encodeJson,
  type OperatorControlMessage,
  type OperatorSessionMessage,
  operatorControlCodec,
  operatorSessionCodec,
  type RobotControlMessage,
  type RobotEndReason,
  type RobotListing,
  type RobotSessionMessage,
  robotControlCodec,
  robotSessionCodec,
  type TelemetryMessage,
  telemetryCodec,
} from '@farpoint/protocol';
import type { ChangedRobotKey } from '../access/session-admission.ts';
import { KeptLink } from '../link/kept-link.ts';
import type { RobotLinkEvents, SignalingState } from '../link/robot-link.ts';
import type { RobotChannel } from '../session/robot-session.ts';
import type { SessionLoss } from '../session/session-loss.ts';
import type { StatusFeed } from '../signaling/status-feed.ts';
import type { VideoTrack } from '../video/video-track.ts';
import type { CloudWorkerHere } from './cloud-worker-here.ts';

/** Neither the shortest nor the longest of the random waits. */
const MIDDLE = 0.5;

/** Everything that a client sends to a robot. */
export type SentMessage = OperatorSessionMessage | OperatorControlMessage;
/** Everything that a robot sends to a client. */
export type ToldMessage = RobotSessionMessage | RobotControlMessage | TelemetryMessage;

/** What a script does about the link. */
export interface LinkScript {
  /** The client asks for a session with this robot. {@link ScriptedLink.admit} opens it. */
  onRequest(robotId: string): void;
  /** The client has sent something, and the path carries it. */
  onSent(message: SentMessage): void;
}

export class ScriptedLink extends KeptLink {
  /** What the client has sent in all sessions, in this order; also what was lost on a path that is cut. */
  readonly sent: SentMessage[] = [];
  signInUrl: string | null = null;
  /** What the robots say about themselves; a test may put another one in its place. */
  statusFeed: StatusFeed = { statuses: new Map(), watchStatuses: () => {} };
  signaling: SignalingState = 'waiting';
  /** Whether packets arrive, in both directions. */
  isCut = false;
  readonly #worker: CloudWorkerHere;
  readonly #script: LinkScript;

  constructor(worker: CloudWorkerHere, events: RobotLinkEvents, script: LinkScript) {
    super(events, () => MIDDLE);
    this.#worker = worker;
    this.#script = script;
  }

  /** The connection to the signaling service is in this state now. */
  enterSignaling(state: SignalingState): void {
    this.signaling = state;
    this.onSignalingState(state);
  }

  /** The service lists these robots now. */
  list(robots: readonly RobotListing[]): void {
    this.onListed(robots);
  }

  /** The requested session is there: the robot's messages come next. */
  admit(): void {
    this.beginSession();
    this.keeper.onOpened(this.#name, this.robotId ?? '');
    this.#worker.begin(this.generation);
    this.onPeerConnected();
  }

  /** The robot ends the session, or refuses it. @param maxOperators of a robot that is full */
  end(reason: RobotEndReason, detail: string | null = null, maxOperators: number | null = null): void {
    if (this.keeper.session === null) this.keeper.onOpened(this.#name, this.robotId ?? '');
    this.lossDetail = detail;
    if (maxOperators !== null) this.maxOperators = maxOperators;
    this.keeper.onClosed(this.#name, reason, performance.now());
  }

  /** The client itself gives the session up. @param changed the keys, after `robot-key-changed` */
  fail(loss: SessionLoss, changed: ChangedRobotKey | null = null): void {
    this.changedRobotKey = changed;
    this.keeper.onPeerFailed(performance.now(), loss);
  }

  /** The service refuses a request, in these words. */
  refuse(message: string): void {
    this.events.onRefusal(message);
    this.keeper.onRefused(undefined, performance.now());
  }

  /** The robot sends this. It is lost on a path that is cut. */
  tell(message: ToldMessage): void {
    if (message.type === 'clockAnswer' || message.type === 'estopAck')
      this.receive('control', encodeJson(robotControlCodec, message));
    else if (isTelemetry(message)) this.receive('telemetry', encodeJson(telemetryCodec, message));
    else this.receive('session', encodeJson(robotSessionCodec, message));
  }

  /** Data come on a channel, whatever they are. */
  receive(channel: RobotChannel, data: string | Uint8Array): void {
    if (this.isCut || this.phase !== 'live') return;
    const malformed = this.session.malformed;
    this.onMessage(channel, data);
    if (this.session.malformed > malformed)
      throw new Error(`a robot would not send this on ${channel}: ${data}`);
  }

  /** A packet of the robot's clouds comes. @param sequence its number */
  receivePacket(payload: ArrayBuffer, sequence: number): void {
    if (!this.isCut && this.phase === 'live') this.#worker.take(payload, sequence);
  }

  /** The browser has made the track of a video that the robot offers. */
  offerVideo(track: VideoTrack): void {
    this.events.onVideoTrack(track);
  }

  sendControl(message: OperatorControlMessage): void {
    if (this.phase !== 'live') return;
    this.#send(decodeJson(operatorControlCodec, encodeJson(operatorControlCodec, message)));
  }

  sendSession(message: OperatorSessionMessage): void {
    if (this.phase !== 'live') return;
    this.#send(decodeJson(operatorSessionCodec, encodeJson(operatorSessionCodec, message)));
  }

  limitBandwidth(): void {}

  sendReport(): void {}

  protected requestSession(robotId: string): void {
    this.#script.onRequest(robotId);
  }

  protected resumeSession(): void {}
  protected closeSession(): void {}
  protected dropPeer(): void {}

  get #name(): string {
    return `scripted-${this.generation}`;
  }

  #send(message: SentMessage): void {
    this.sent.push(message);
    if (!this.isCut) this.#script.onSent(message);
  }
}

/** Every type of the telemetry channel. */
const TELEMETRY: Readonly<Record<TelemetryMessage['type'], true>> = {
  telemetry: true,
  nearField: true,
  reading: true,
  samples: true,
  diagnostics: true,
  path: true,
  map: true,
  joints: true,
  stages: true,
};

function isTelemetry(message: ToldMessage): message is TelemetryMessage {
  return message.type in TELEMETRY;
}
