export {
  type ActionStep,
  actionServices,
  cancelRequest,
  feedbackGoal,
  goalRequest,
  readCancelReply,
  readGoalReply,
  readGoalSteps,
  readResultStep,
  resultRequest,
} from './action-wire.ts';
export { BatteryGauge, type GaugeReading } from './battery-gauge.ts';
export { compressedPicture } from './compressed-picture.ts';
export { definitionsOf } from './definitions.ts';
export { DIAGNOSTIC_LEVELS, DiagnosticBoard } from './diagnostic-board.ts';
export { messageFault, RosFault, type RosFaultCode } from './fault.ts';
export { fixedMessage } from './fixed-message.ts';
export {
  actionTypes,
  cancelMessage,
  goalDefinitions,
  goalMessage,
  isLastStatus,
  readGoalStatus,
  ros2GoalDefinitions,
} from './goal-wire.ts';
export {
  type AdvertiseAs,
  callsServices,
  type GraphTopic,
  LATCHED_QOS,
  type OnMessage,
  type Publisher,
  type Qos,
  RELIABLE_QOS,
  type RosGraph,
  SENSOR_QOS,
  type ServiceAs,
  type ServiceClient,
  type ServiceGraph,
  type SubscribeTo,
  type Subscription,
  VELOCITY_QOS,
} from './graph.ts';
export { colourOf, depthOf, GREY, type Pinhole, pinholeOf } from './image.ts';
export { type ImagePair, ImagePairs } from './image-pairs.ts';
export { decoderOf, lazyDecoder, type MessageSchema } from './message-decoder.ts';
export { definitionsFromFiles, type ReadMessageFile } from './message-files.ts';
export { type MessageSlot, MessageSlots } from './message-slots.ts';
export {
  BATTERY_TYPES,
  type CameraInfo,
  type CompressedImage,
  cameraInfoSchema,
  compressedImageSchema,
  DIAGNOSTIC_TYPES,
  FOXGLOVE_COMPRESSED_IMAGE_TYPES,
  FOXGLOVE_COMPRESSED_VIDEO_TYPES,
  FOXGLOVE_RAW_IMAGE_TYPES,
  foxgloveCompressedImageSchema,
  foxgloveCompressedVideoSchema,
  foxgloveRawImageSchema,
  type Image,
  imageSchema,
  type LaserScan,
  laserScanSchema,
  ODOMETRY_TYPES,
  POINT_CLOUD_TYPES,
  type PointCloud2,
  type PointField,
  pointCloud2Schema,
  stampNs,
  TF_TYPES,
} from './messages.ts';
export {
  type NavigationNews,
  type NavigationRefusal,
  navigationRefusals,
  type OccupancyMap,
} from './navigation-news.ts';
export { type FramePose, NavigationTopic } from './navigation-topic.ts';
export { type ImageRows, MOST_PICTURE_PIXELS, pictureRows } from './picture-rows.ts';
export { axesOf, checkedCount, PointCloud2Decoder } from './point-cloud2.ts';
export { FLOAT32 } from './point-field.ts';
export type { CloudAxes } from './point-words.ts';
export { RateLimit } from './rate-limit.ts';
export { fixStampNs, readingOf, shortened, type TopicReading } from './reading.ts';
export {
  readStdServiceReply,
  SERVICE_TYPES,
  type ServiceReply,
  type ServiceType,
  stdServiceRequest,
  stdServiceTypes,
} from './std-services.ts';
export { numbersOf, quantitiesOf, type TopicQuantity } from './topic-quantities.ts';
export {
  MOST_TOPICS,
  qosOf,
  ros1TypeOf,
  ros2TypeOf,
  STATIC_SUFFIX,
  TOPIC_ROLES,
  type TopicEntry,
  type TopicRole,
  type TopicTable,
  topicAs,
  topicTableSchema,
} from './topic-table.ts';
export { TransformTree } from './transform-tree.ts';
export type { JointSource } from './urdf/joint-sources.ts';
export { ModelTopic, modelReading, newsOf } from './urdf/model-topic.ts';
export { type JointNews, type ModelNews, type RobotModel, readUrdf } from './urdf/read-urdf.ts';
export { UrdfFault, type UrdfFaultCode, urdfFaultCodes } from './urdf/urdf-fault.ts';
export { type VelocityWriter, velocityWriter } from './velocity.ts';
export { ENCAPSULATION_BYTES } from './wire-check.ts';
export {
  type BaseMotion,
  type PlacedSensor,
  type StampTimes,
  type TypedTopic,
  WorldState,
} from './world-state.ts';
