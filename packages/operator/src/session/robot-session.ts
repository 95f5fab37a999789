/** What the robot has sent on its channels in this session. Takes bytes and the time; no channel and no clock here. */
import {
  type Alarm,
  ageOfStampMs,
  type Cameras,
  ClockOffset,
  type CloudStream,
  type CommandRefused,
  type CommandRejected,
  type CommandRun,
  type Diagnostics,
  decodeJson,
  type EstopCause,
  type EstopState,
  type Handover,
  type LatencyFrame,
  type LeaseState,
  type MapTiles,
  type MessageData,
  type NearField,
  nextSequence32,
  type Operators,
  PictureAssembler,
  type PlannedPath,
  type Pointed,
  ProtocolError,
  type Quantity,
  type Reading,
  type RecordingState,
  type RobotAbout,
  type RobotCommand,
  type RobotSessionMessage,
  robotControlCodec,
  robotSessionCodec,
  type Samples,
  type SensorRings,
  type Sensors,
  type Sound,
  type StageTimes,
  sequenceDelta32,
  type Telemetry,
  telemetryCodec,
  type Videos,
  type Welcome,
  type WholePicture,
} from '@farpoint/protocol';
import { ComponentReports } from './component-reports.ts';
import { NavigatorMap } from './navigator-map.ts';
import { NavigatorPath } from './navigator-path.ts';
import { NearSurroundings } from './near-surroundings.ts';
import { Readings } from './readings.ts';
import { RobotModel } from './robot-model.ts';
import { RobotPeople } from './robot-people.ts';

/** Channels on which the robot sends. */
export type RobotChannel = 'session' | 'telemetry' | 'control' | 'pictures';

export interface RobotSessionEvents {
  /** The robot's first message of a session. */
  onWelcome(welcome: Welcome): void;
  /** The operator's grant ends soon. */
  onGrantExpires(inS: number): void;
  /** Somebody else drives now, or nobody. */
  onLease(lease: LeaseState): void;
  /** Who has a session with the robot. */
  onOperators(operators: Operators): void;
  /** A request for the drive or an offer of it, made or ended, that concerns this operator. */
  onHandover(handover: Handover): void;
  /** A command that the robot takes besides driving, or whether it may be given has changed. */
  onRobotCommand(command: RobotCommand): void;
  /** Such a command was begun, progresses or has ended. */
  onCommandRun(run: CommandRun): void;
  /** The robot has refused such a command of this operator. */
  onCommandRefused(refused: CommandRefused): void;
  /** How much the robot has recorded. */
  onRecording(recording: RecordingState): void;
  /** Another operator points at a spot. */
  onPointed(pointed: Pointed): void;
  /** The robot has refused a command. */
  onRejected(rejected: CommandRejected): void;
  /** The state of the emergency stop. */
  onEstop(estop: EstopState): void;
  /** The robot has latched its emergency stop because of this press. */
  onEstopAck(press: number): void;
  /** The frame of a latency test that the robot has painted. */
  onLatencyFrame(frame: LatencyFrame): void;
  /** How the robot moves, where it is, and what it takes of the link. */
  onTelemetry(telemetry: Telemetry): void;
  /** A reading that is the newest of its topic. */
  onReading(reading: Reading): void;
  /** A number that the robot measures over time. */
  onQuantity(quantity: Quantity): void;
  /** Samples of such numbers. They may come late: the channel is unordered. */
  onSamples(samples: Samples): void;
  /** What is near the robot. */
  onNearField(field: NearField): void;
  /** The robot's navigator has planned another path. */
  onPlannedPath(path: PlannedPath): void;
  /** Something of the robot's map is new. */
  onMap(tiles: MapTiles): void;
  /** Reports of the robot's components. */
  onDiagnostics(diagnostics: Diagnostics): void;
  /** An alarm was raised, changed its level or was cleared. */
  onAlarm(alarm: Alarm): void;
  /** The header with which a stream's coded packets are decoded. */
  onCloudStream(stream: CloudStream): void;
  /** The cameras whose pictures can be requested. */
  onCameras(cameras: Cameras['cameras']): void;
  /** The sensors whose clouds can be requested; sent by robots that have more than one. */
  onSensors(sensors: Sensors['sensors']): void;
  /** The rings of a LiDAR among the sensors. */
  onRings(rings: SensorRings): void;
  /** The cameras whose videos can be requested, and which of them have no pictures at present. */
  onVideos(videos: Videos['videos']): void;
  /** The robot's microphone, and what becomes of this operator's voice. */
  onSound(sound: Sound): void;
  /** A camera's picture; `nowMs`: when its last packet arrived, `performance.now()`. */
  onPicture(picture: WholePicture, nowMs: number): void;
  /** When frames and commands passed the robot's stations; `nowMs`: when it was told, `performance.now()`. */
  onStages(times: StageTimes, nowMs: number): void;
  /** The robot could not use a message from this client. */
  onRobotFault(message: string): void;
}

/** What to do with each message of the `session` channel. */
type SessionHandlers = {
  readonly [Type in RobotSessionMessage['type']]: (
    message: Extract<RobotSessionMessage, { type: Type }>,
    nowMs: number,
  ) => void;
};

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
  /** What they ask of each other. */
  readonly people = new RobotPeople();
  /** Whether the robot passes on at which spot this operator points; `null` if it passes nothing on, as older robots. */
  mayPoint: boolean | null = null;
  /** Whether the emergency stop is latched. */
  estop: EstopState = { type: 'estop', latched: false };
  /** Who pressed STOP, why else the robot stands, and who may release it; `null` if the robot has not said so of the present latch. */
  estopCause: EstopCause | null = null;
  /** What must be known of the robot; `null` if it does not say. */
  about: RobotAbout | null = null;
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
  readonly #handlers: SessionHandlers = {
    welcome: (welcome, nowMs) => {
      this.welcome = welcome;
      this.#grantEnds(welcome.access?.expiresInS, nowMs);
      this.#events.onWelcome(welcome);
    },
    expires: ({ inS }, nowMs) => {
      this.#grantEnds(inS, nowMs);
      this.#events.onGrantExpires(inS);
    },
    lease: (lease) => {
      this.lease = lease;
      this.#events.onLease(lease);
    },
    operators: (operators, nowMs) => {
      this.operators = operators;
      this.people.onOperators(operators, nowMs);
      this.#events.onOperators(operators);
    },
    handover: (handover, nowMs) => {
      this.people.onHandover(handover, nowMs);
      this.#events.onHandover(handover);
    },
    robotCommand: (command) => this.#events.onRobotCommand(command),
    commandRun: (run) => this.#events.onCommandRun(run),
    commandRefused: (refused) => this.#events.onCommandRefused(refused),
    recording: (recording) => this.#events.onRecording(recording),
    pointing: ({ may }) => {
      this.mayPoint = may;
    },
    pointed: (pointed) => this.#events.onPointed(pointed),
    rejected: (rejected) => this.#events.onRejected(rejected),
    estop: (estop) => {
      this.estop = estop;
      if (!estop.latched || estop.latch !== this.estopCause?.latch) this.estopCause = null;
      this.#events.onEstop(estop);
    },
    // The `estop` message that it explains comes next.
    estopCause: (cause) => {
      this.estopCause = cause;
    },
    about: (about) => {
      this.about = about;
    },
    latencyFrame: (frame) => this.#events.onLatencyFrame(frame),
    cloudStream: (stream) => this.#events.onCloudStream(stream),
    cameras: ({ cameras }) => {
      this.pictures.cameras = cameras.length;
      this.#events.onCameras(cameras);
    },
    sensors: ({ sensors }) => this.#events.onSensors(sensors),
    rings: (rings) => this.#events.onRings(rings),
    videos: ({ videos }) => this.#events.onVideos(videos),
    robotModel: (parts) => this.model.takeParts(parts),
    quantity: (quantity) => {
      this.quantities.set(quantity.number, quantity);
      this.#events.onQuantity(quantity);
    },
    alarm: (alarm) => {
      if (alarm.level === 'ok') this.alarms.delete(alarm.number);
      else this.alarms.set(alarm.number, alarm);
      this.#events.onAlarm(alarm);
    },
    sound: (sound) => this.#events.onSound(sound),
    fault: ({ message }) => this.#events.onRobotFault(message),
  };

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
    const handle = this.#handlers[message.type] as (message: RobotSessionMessage, nowMs: number) => void;
    handle(message, nowMs);
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
      case 'stages':
        this.#events.onStages(telemetry, nowMs);
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
