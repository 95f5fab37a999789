export { RosFault, type RosFaultCode } from './fault.ts';
export {
  type AdvertiseAs,
  type GraphTopic,
  LATCHED_QOS,
  type OnMessage,
  type Publisher,
  type Qos,
  RELIABLE_QOS,
  type RosGraph,
  SENSOR_QOS,
  type SubscribeTo,
  type Subscription,
} from './graph.ts';
export { lazyDecoder, type MessageSchema } from './message-decoder.ts';
export {
  BATTERY_TYPES,
  type CameraInfo,
  cameraInfoSchema,
  type Image,
  imageSchema,
  ODOMETRY_TYPES,
  POINT_CLOUD_TYPES,
  type PointCloud2,
  type PointField,
  pointCloud2Schema,
  stampNs,
  TF_TYPES,
} from './messages.ts';
export { axesOf, type CloudAxes, checkedCount, PointCloud2Decoder } from './point-cloud2.ts';
export {
  ros1TypeOf,
  ros2TypeOf,
  TOPIC_ROLES,
  type TopicEntry,
  type TopicRole,
  type TopicTable,
  topicAs,
  topicTableSchema,
} from './topic-table.ts';
export { TransformTree } from './transform-tree.ts';
export { type TypedTopic, WorldState } from './world-state.ts';
