/**
 * The operator's side of a Farpoint session, for browsers: signaling, the WebRTC connection, decoding of clouds and
 * pictures in workers, drive commands, emergency stop and latency measurement. Begin with {@link connect}.
 *
 * @module operator
 */

// What the robot's events are made of.
export type {
  AfterGap,
  Alarm,
  Battery,
  BodyHeights,
  Broadcast,
  Cameras,
  CloudFormat,
  CommandBar,
  CommandRefusal,
  CommandRejected,
  CommandRejection,
  CommandState,
  DiagnosticLevel,
  DiagnosticReport,
  Diagnostics,
  DriveLimits,
  DriveState,
  EstopCause,
  EstopReleasePolicy,
  EstopStart,
  EstopState,
  Handover,
  HandoverEnd,
  HandoverKind,
  LatencyFrame,
  LeaseState,
  MapTiles,
  MicrophoneState,
  ModelLink,
  ModelPlace,
  ModelShape,
  NamedOperator,
  NearField,
  NearKind,
  NearSector,
  Operators,
  PlannedPath,
  Pointed,
  Pose,
  PresentOperator,
  Quantity,
  Quaternion,
  Reading,
  ReadingLevel,
  RecordingState,
  RobotAbout,
  RobotBody,
  RobotCommand,
  RobotListing,
  RobotStop,
  Role,
  Sample,
  Samples,
  SensorRings,
  Sensors,
  Sound,
  Spot,
  StageTimes,
  StageTimings,
  StreamStatus,
  Telemetry,
  Twist,
  Vector3,
  VideoCodec,
  VideoDescription,
  Videos,
  VoiceState,
  Welcome,
} from '@farpoint/protocol';
export { type KnownRobots, knownInMemory } from './access/known-robots.ts';
export {
  claimsOfGrant,
  type GrantClaims,
  grantFor,
  type OperatorCredentials,
  readTicket,
} from './access/operator-credentials.ts';
export { keyThumbprint, makeOperatorKey, type OperatorJwk, type OperatorKey } from './access/operator-key.ts';
export type { ChangedRobotKey } from './access/session-admission.ts';
export { type BridgeAddress, parseBridge } from './bridge/bridge-settings.ts';
export type { RobotClientOptions } from './client/client-options.ts';
export { ConnectError, type ConnectFailure, type ConnectOptions, connect } from './client/connect.ts';
export { PeopleRequests } from './client/people-requests.ts';
export { RobotClient } from './client/robot-client.ts';
export type { ClientFailure, RobotEvents } from './client/robot-events.ts';
export {
  BATCH_BYTES,
  BATCH_PACKETS,
  BATCH_POINTS,
  BATCH_TILES,
  Batch,
  type PointLook,
  type TileGrid,
} from './cloud/batch.ts';
export { DEFAULT_EXTENT } from './cloud/image-extent.ts';
export type { DropCounts, DropReason } from './cloud/packet-intake.ts';
export type { IntakeReport } from './cloud/worker-messages.ts';
export { type CommandEnd, type CommandRunning, RobotCommands } from './commands/robot-commands.ts';
export { activeInput, type DriveInput, type PressedButtons } from './drive/drive-input.ts';
export type { Driver } from './drive/driver.ts';
export { type GripLoss, READING_HOLDS_MS } from './drive/grips.ts';
export { robotAfter } from './drive/robot-switch.ts';
export type { SeenView } from './drive/seen-view.ts';
export { type DriveWish, toTwist } from './drive/velocity-mapping.ts';
export {
  captureMsOfRtp,
  captureMsOfStamp,
  isSameInstant,
  SAME_INSTANT_US,
} from './instant/capture-instant.ts';
export type { ItemDropReason } from './instant/capture-source.ts';
export {
  CloudHold,
  type CloudHoldStats,
  driverHold,
  type HoldLimit,
  noHold,
  watcherHold,
} from './instant/cloud-hold.ts';
export {
  Compositor,
  type CompositorOptions,
  type DroppedItem,
  type Presentation,
  type PresentedItem,
} from './instant/compositor.ts';
export type { CompositorStats, SourceFigures, SourceState } from './instant/compositor-statistics.ts';
export {
  type ClockedCloudSource,
  type CloudSource,
  HeldClouds,
  type SessionClock,
} from './instant/held-clouds.ts';
export { type CommandStage, type CommandStages, commandStages } from './latency/command-stages.ts';
export { type FrameStage, type FrameStages, frameStages } from './latency/frame-stages.ts';
export { LatencyError, type LatencyProbe, type LatencyReport } from './latency/latency-probe.ts';
export type { LatencyFailure, LatencyResult } from './latency/latency-test.ts';
export { type Distribution, SampleWindow } from './latency/sample-window.ts';
export {
  STAGES_KEPT_MS,
  type StageRow,
  type StageSummary,
  type StageWindow,
} from './latency/stage-window.ts';
export type { RobotLink, RobotLinkEvents, SignalingState } from './link/robot-link.ts';
export { MEMORY_LAYOUT } from './memory/memory-layout.ts';
export type { MemoryStats } from './memory/memory-messages.ts';
export type { MemoryPages } from './memory/memory-pages.ts';
export { POINT_FILE_FORMATS, type PointFileFormat } from './memory/point-file.ts';
export type { MotionLimits } from './memory/pose-jump.ts';
export { TOP_VIEW, type TopView, type TopViewArea } from './memory/top-view.ts';
export { MemoryFileError, type MemoryListener, WorldMemory } from './memory/world-memory.ts';
export { type TransformSupport, transformSupport } from './peer/encoded-transform.ts';
export type { Picture } from './pictures/picture-feed.ts';
export { ComponentReports, type ReportedComponents } from './session/component-reports.ts';
export type { MapPlace, NavigatorMap } from './session/navigator-map.ts';
export type { NavigatorPath } from './session/navigator-path.ts';
export type { NearSurroundings } from './session/near-surroundings.ts';
export { type AgedReading, Readings } from './session/readings.ts';
export { LOST_AFTER_MS } from './session/resume-policy.ts';
export { RobotModel } from './session/robot-model.ts';
export { givesYou, type OpenHandover, RobotPeople } from './session/robot-people.ts';
export type { RobotSession } from './session/robot-session.ts';
export type { SessionPhase } from './session/session-keeper.ts';
export { finalLosses, lossOf, type SessionLoss } from './session/session-loss.ts';
export {
  isPrivateAddress,
  parseSignalingUrl,
  type SignalingAddress,
  type SignalingAddressFault,
} from './signaling/signaling-url.ts';
export type { StatusFeed } from './signaling/status-feed.ts';
export type { PlayedSound, RobotSound, VoiceStatus } from './sound/robot-sound.ts';
export type { VoiceFailure, VoiceFailureReason } from './sound/voice-failure.ts';
export type { SensorStats } from './statistics/sensor-statistics.ts';
export type { StreamStatistics, StreamStats } from './statistics/stream-statistics.ts';
export type { StopDelivery, StopStatus } from './stop/stop-delivery.ts';
export type { VideoTrack } from './video/video-track.ts';
export { RobotWatcher, type RobotWatcherOptions } from './watch/robot-watcher.ts';
export type { WatchEvents, WatchObstacle, WatchPhase, WatchState } from './watch/watch-state.ts';
