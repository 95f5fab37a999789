export * from './alarm.ts';
export * from './bandwidth.ts';
export * from './barcode-time.ts';
export * from './broadcast.ts';
export * from './capture-stamp.ts';
export * from './channels.ts';
export * from './clock-offset.ts';
export * from './cloud-format.ts';
export * from './cloud-payload.ts';
export * from './colour664.ts';
export * from './control.ts';
export * from './diagnostics.ts';
export * from './errors.ts';
export {
  type EstopCause,
  type EstopReleasePolicy,
  type EstopStart,
  estopReleasePolicies,
  type RobotStop,
  robotStops,
} from './estop-cause.ts';
export * from './estop-press.ts';
export * from './geometry.ts';
export {
  type DriveRequest,
  HANDOVER_MS,
  type Handover,
  type HandoverEnd,
  type HandoverKind,
  handoverEnds,
} from './handover.ts';
export * from './identifiers.ts';
export * from './interventions.ts';
export * from './json.ts';
export * from './latency-barcode.ts';
export * from './latency-barcode-reader.ts';
export {
  MAP_TILE,
  MAX_MAP_SIDE,
  type MapSize,
  type MapTiles,
  mapCells,
  type TileExtent,
  tileCount,
  tileExtent,
  tileRuns,
  writeTile,
} from './map-tiles.ts';
export * from './motion-state.ts';
export {
  NEAR_REACH_M,
  NEAR_SECTORS,
  NEAR_STEP_M,
  NEAR_UNSEEN_M,
  type NearField,
  type NearKind,
  type NearSector,
  nearFieldText,
  nearKinds,
  nearSectors,
} from './near-field.ts';
export * from './picture-assembler.ts';
export * from './picture-chunk.ts';
export * from './picture-file.ts';
export * from './placement.ts';
export { MAX_PATH_POINTS, MAX_PLACE_M, type PlannedPath } from './planned-path.ts';
export * from './point-packet.ts';
export { POINT_SHOWN_MS, type Point, type Pointed, type Pointing, type Spot } from './pointing.ts';
export * from './points64.ts';
export * from './pose-algebra.ts';
export {
  MAX_LISTED_OPERATORS,
  type NamedOperator,
  type Operators,
  type PresentOperator,
  type Role,
  roles,
} from './present-operators.ts';
export * from './quantity.ts';
export * from './reading.ts';
export * from './reference-bridge.ts';
export * from './return-state.ts';
export { type RobotAbout, shownSources } from './robot-about.ts';
export { type BodyHeights, OWN_BODY_M, type RobotBody } from './robot-body.ts';
export {
  BOOKMARK_LENGTH,
  COMMAND_DETAIL_LENGTH,
  COMMAND_ID,
  type CommandBar,
  type CommandCall,
  type CommandCancel,
  type CommandRefusal,
  type CommandRefused,
  type CommandRun,
  type CommandState,
  MAX_ROBOT_COMMANDS,
  type RecordingState,
  type RobotCommand,
} from './robot-command.ts';
export {
  type JointPositions,
  MAX_JOINT_POSITION,
  MAX_MODEL_LINKS,
  MAX_MODEL_M,
  MAX_MODEL_SHAPES,
  type ModelLink,
  type ModelPart,
  type ModelPlace,
  type ModelShape,
  type RobotModelParts,
} from './robot-model.ts';
export { MAX_RINGS, type SensorRings } from './sensor-rings.ts';
export * from './sequence.ts';
export { operatorSessionCodec, robotSessionCodec } from './session-codecs.ts';
export * from './session-messages.ts';
export * from './session-requests.ts';
export * from './sign-in.ts';
export * from './signaling/farpoint.ts';
export * from './signaling/reference.ts';
export {
  applyStatusesChanged,
  type RobotState,
  type RobotStatus,
  type StatusOfRobot,
} from './signaling/robot-status.ts';
export * from './signaling/signaling-endpoint.ts';
export * from './sound-media.ts';
export {
  type CommandTimes,
  type FrameTimes,
  MOST_STAGE_ROWS,
  MOST_STAGE_US,
  type StageTimes,
} from './stage-times.ts';
export * from './telemetry.ts';
export * from './unorganised-stream.ts';
export * from './video-media.ts';
