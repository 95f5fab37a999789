/** What the robot has sent on its channels in this session. Takes bytes and the time; no channel and no clock here. */
import {
  type Alarm,
  ageOfStampMs,
  ClockOffset,
  decodeJson,
  type EstopCause,
  type EstopState,
  type LeaseState,
  type MessageData,
  nextSequence32,
  type Operators,
  PictureAssembler,
  ProtocolError,
  type Quantity,
  type RobotAbout,
  robotControlCodec,
  robotSessionCodec,
  sequenceDelta32,
  type Telemetry,
  telemetryCodec,
  type Welcome,
} from '@farpoint/protocol';
import { ComponentReports } from './component-reports.ts';
import { NavigatorMap } from './navigator-map.ts';
import { NavigatorPath } from './navigator-path.ts';
import { NearSurroundings } from './near-surroundings.ts';
import { Readings } from './readings.ts';
import { RobotModel } from './robot-model.ts';
import { RobotPeople } from './robot-people.ts';
import type { RobotSessionEvents } from './robot-session-events.ts';

/** Channels on which the robot sends. */
export type RobotChannel = 'session' | 'telemetry' | 'control' | 'pictures';

/** What the robot has sent in this session. {@link RobotLink} creates one for each session. */
export class RobotSession {
  /** The robot's first message; `null` until it arrives. */
  welcome: Welcome | null = null;
  /** When the operator's grant ends, `performance.now()`; `null` if the robot asks for none. */
  grantEndsAtMs: number | null = null;
  /** Who drives. */
  lease: LeaseState = { type: 'lease', holder: 'nobody' };
  /** Who has a session with the robot; `null` until the robot says so. */
  operators: Operators | null = null;
  /** What they ask of each other, and say. */
  readonly people = new RobotPeople();
  /** What must be known of the robot before it is used; `null` if it does not say. */
  about: RobotAbout | null = null;
  /** Whether the emergency stop is latched. */
  estop: EstopState = { type: 'estop', latched: false };
  /** Who pressed STOP and who may release it; `null` if the robot has not said so of the present latch. */
  estopCause: EstopCause | null = null;
  /** The robot's latest telemetry; `null` before the first. */
  telemetry: Telemetry | null = null;
  /** What is near the robot, in each direction. */
  readonly near = new NearSurroundings();
  /** What the robot's navigator has planned. */
  readonly plannedPath = new NavigatorPath();
  /** What the robot's map says. */
  readonly map = new NavigatorMap();
  /** What the robot looks like, and where its joints are. */
  readonly model = new RobotModel();
  /** Readings of the robot's sensors and topics. */
  readonly readings = new Readings();
  /** The numbers that the robot measures over time, by the number in their samples. */
  readonly quantities = new Map<number, Quantity>();
  /** What the robot's components report about themselves. */
  readonly components = new ComponentReports();
  /** The alarms that are raised now, by their number. */
  readonly alarms = new Map<number, Alarm>();
  /** Assembles the cameras' pictures from their messages. */
  readonly pictures = new PictureAssembler();
  /** Estimate of the robot's clock. */
  readonly clock = new ClockOffset();
  /** Number of messages that do not conform to the protocol and were ignored. */
  malformed = 0;
  #probeId = 0;
  readonly #events: RobotSessionEvents;

  /** @param events called for each message */
  constructor(events: RobotSessionEvents) {
    this.#events = events;
  }

  /**
   * Takes a message from the robot. One that does not conform to the protocol is counted and ignored.
   *
   * @param nowMs when it arrived, `performance.now()`
   */
  onMessage(channel: RobotChannel, data: MessageData, nowMs: number): void {
    try {
      if (channel === 'session') this.#onSession(data, nowMs);
      else if (channel === 'telemetry') this.#onTelemetry(data, nowMs);
      else if (channel === 'pictures') this.#onPicture(data, nowMs);
      else this.#onControl(data, nowMs);
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.malformed++;
    }
  }

  /** Number for the next clock probe; wraps at 2³². */
  nextProbeId(): number {
    this.#probeId = nextSequence32(this.#probeId);
    return this.#probeId;
  }

  /**
   * The age of a timestamp of the robot's clock, ms; `null` until its clock is known.
   *
   * @param stampUs of the robot's monotonic clock, µs, modulo 2³²
   * @param nowMs `performance.now()`
   */
  ageMs(stampUs: number, nowMs: number): number | null {
    const { offsetMs } = this.clock;
    return offsetMs === null ? null : ageOfStampMs(stampUs, nowMs + offsetMs);
  }

  #onControl(data: MessageData, nowMs: number): void {
    const message = decodeJson(robotControlCodec, data);
    if (message.type === 'clockAnswer') this.clock.add(message, nowMs);
    else this.#events.onEstopAck(message.press);
  }

  #onSession(data: MessageData, nowMs: number): void {
    const message = decodeJson(robotSessionCodec, data);
    switch (message.type) {
      case 'welcome':
        this.welcome = message;
        this.#grantEnds(message.access?.expiresInS, nowMs);
        this.#events.onWelcome(message);
        return;
      case 'expires':
        this.#grantEnds(message.inS, nowMs);
        this.#events.onGrantExpires(message.inS);
        return;
      case 'lease':
        this.lease = message;
        this.#events.onLease(message);
        return;
      case 'operators':
        this.operators = message;
        this.people.onOperators(message, nowMs);
        this.#events.onOperators(message);
        return;
      case 'handover':
        this.people.onHandover(message, nowMs);
        this.#events.onHandover(message);
        return;
      case 'chatLine':
        this.people.onChatLine(message, nowMs);
        this.#events.onChatLine(message);
        return;
      case 'rejected':
        this.#events.onRejected(message);
        return;
      case 'estop':
        this.estop = message;
        if (message.latch !== this.estopCause?.latch || !message.latched) this.estopCause = null;
        this.#events.onEstop(message);
        return;
      case 'about':
        this.about = message;
        return;
      case 'estopCause':
        // The `estop` message that it explains comes next.
        this.estopCause = message;
        return;
      case 'goalState':
        this.#events.onGoalState(message);
        return;
      case 'robotCommand':
        this.#events.onRobotCommand(message);
        return;
      case 'commandAnswer':
        this.#events.onCommandAnswer(message);
        return;
      case 'latencyFrame':
        this.#events.onLatencyFrame(message);
        return;
      case 'cloudStream':
        this.#events.onCloudStream(message);
        return;
      case 'cameras':
        this.pictures.cameras = message.cameras.length;
        this.#events.onCameras(message.cameras);
        return;
      case 'sensors':
        this.#events.onSensors(message.sensors);
        return;
      case 'rings':
        this.#events.onRings(message);
        return;
      case 'videos':
        this.#events.onVideos(message.videos);
        return;
      case 'robotModel':
        this.model.takeParts(message);
        return;
      case 'modelMeshes':
        this.model.takeMeshes(message);
        return;
      case 'quantity':
        this.quantities.set(message.number, message);
        this.#events.onQuantity(message);
        return;
      case 'alarm':
        if (message.level === 'ok') this.alarms.delete(message.number);
        else this.alarms.set(message.number, message);
        this.#events.onAlarm(message);
        return;
      case 'sound':
        this.#events.onSound(message);
        return;
      case 'fault':
        this.#events.onRobotFault(message.message);
        return;
    }
  }

  #grantEnds(inS: number | undefined, nowMs: number): void {
    this.grantEndsAtMs = inS === undefined ? null : nowMs + inS * 1000;
  }

  #onPicture(data: MessageData, nowMs: number): void {
    if (typeof data === 'string') {
      this.malformed++;
      return;
    }
    const picture = this.pictures.take(data instanceof ArrayBuffer ? new Uint8Array(data) : data);
    if (picture !== null) this.#events.onPicture(picture, nowMs);
  }

  #onTelemetry(data: MessageData, nowMs: number): void {
    const telemetry = decodeJson(telemetryCodec, data);
    switch (telemetry.type) {
      case 'reading':
        if (this.readings.take(telemetry, nowMs)) this.#events.onReading(telemetry);
        return;
      case 'samples':
        this.#events.onSamples(telemetry);
        return;
      case 'nearField':
        if (this.near.take(telemetry, nowMs)) this.#events.onNearField(telemetry);
        return;
      case 'path':
        if (this.plannedPath.take(telemetry, nowMs)) this.#events.onPlannedPath(telemetry);
        return;
      case 'map':
        if (this.map.take(telemetry, nowMs)) this.#events.onMap(telemetry);
        return;
      case 'joints':
        this.model.takeJoints(telemetry, nowMs);
        return;
      case 'diagnostics':
        this.components.take(telemetry);
        this.#events.onDiagnostics(telemetry);
        return;
    }
    // The channel is unordered: ignore telemetry that was overtaken.
    if (this.telemetry !== null && sequenceDelta32(telemetry.sequence, this.telemetry.sequence) <= 0) return;
    this.telemetry = telemetry;
    this.#events.onTelemetry(telemetry);
  }
}
