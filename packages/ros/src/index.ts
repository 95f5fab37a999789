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
