/** What a session tells of the messages that the robot sends in it. */
import type {
  Alarm,
  Cameras,
  ChatLine,
  CloudStream,
  CommandAnswer,
  CommandRejected,
  Diagnostics,
  EstopState,
  GoalState,
  Handover,
  LatencyFrame,
  LeaseState,
  MapTiles,
  NearField,
  Operators,
  PlannedPath,
  Quantity,
  Reading,
  RobotCommand,
  Samples,
  SensorRings,
  Sensors,
  Sound,
  Telemetry,
  Videos,
  Welcome,
  WholePicture,
} from '@farpoint/protocol';

export interface RobotSessionEvents {
  onWelcome(welcome: Welcome): void;
  /** The operator's grant ends soon. */
  onGrantExpires(inS: number): void;
  onLease(lease: LeaseState): void;
  /** Who has a session with the robot. */
  onOperators(operators: Operators): void;
  /** A request for the drive or an offer of it, made or ended, that concerns this operator. */
  onHandover(handover: Handover): void;
  /** An operator said a line; after the welcome also those that were said before. */
  onChatLine(line: ChatLine): void;
  onRejected(rejected: CommandRejected): void;
  onEstop(estop: EstopState): void;
  /** The robot has latched its emergency stop because of this press. */
  onEstopAck(press: number): void;
  /** What has become of this operator's goal. */
  onGoalState(state: GoalState): void;
  /** A command that the robot takes, and whether it takes it from this operator now. */
  onRobotCommand(command: RobotCommand): void;
  /** What became of one that this operator gave. */
  onCommandAnswer(answer: CommandAnswer): void;
  onLatencyFrame(frame: LatencyFrame): void;
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
  onPicture(picture: WholePicture, nowMs: number): void;
  /** The robot could not use a message from this client. */
  onRobotFault(message: string): void;
}
