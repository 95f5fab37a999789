/**
 * Which topics the robot may use, and as what. Topics that are not in the table are neither subscribed nor published,
 * whatever discovery finds.
 */
import { MAX_CAMERAS, MAX_QUANTITIES } from '@farpoint/protocol';
import type { MessageDefinition } from '@foxglove/message-definition';
import * as z from 'zod';
import { LATCHED_QOS, type Qos, RELIABLE_QOS, SENSOR_QOS, VELOCITY_QOS } from './graph.ts';
import { tooManyQuantities, topicQuantitiesSchema } from './topic-quantities.ts';

/** The roles of a topic, and the types allowed for each; the first is used if none is given. */
export const TOPIC_ROLES = {
  /** Points; with a `cameraInfo`, on a depth camera's grid. */
  cloud: ['sensor_msgs/msg/PointCloud2'],
  /** A depth image; it needs a `cameraInfo`. */
  depth: ['sensor_msgs/msg/Image'],
  /** The colour image for `depth`, registered to it. */
  colour: ['sensor_msgs/msg/Image'],
  cameraInfo: ['sensor_msgs/msg/CameraInfo'],
  /** A camera's picture, for people to look at. */
  picture: ['sensor_msgs/msg/Image', 'sensor_msgs/msg/CompressedImage'],
  pose: [
    'nav_msgs/msg/Odometry',
    'geometry_msgs/msg/PoseStamped',
    'geometry_msgs/msg/PoseWithCovarianceStamped',
  ],
  tf: ['tf2_msgs/msg/TFMessage', 'tf/msg/tfMessage'],
  battery: ['sensor_msgs/msg/BatteryState'],
  fix: ['sensor_msgs/msg/NavSatFix'],
  diagnostics: ['diagnostic_msgs/msg/DiagnosticArray'],
  /** What a navigator has planned. */
  path: ['nav_msgs/msg/Path'],
  /** What is free and what is occupied. */
  map: ['nav_msgs/msg/OccupancyGrid'],
  /** The robot's description: URDF. */
  model: ['std_msgs/msg/String'],
  /** Where the joints of the description are. */
  joints: ['sensor_msgs/msg/JointState'],
  /** Any type: its values as text. */
  text: [],
  /** Published: the velocity for the wheels. */
  velocity: ['geometry_msgs/msg/Twist', 'geometry_msgs/msg/TwistStamped'],
} as const satisfies Record<string, readonly string[]>;

export type TopicRole = keyof typeof TOPIC_ROLES;
const roles = Object.keys(TOPIC_ROLES) as [TopicRole, ...TopicRole[]];

/** Messages per second that are read of what is shown to people, unless the table says otherwise; others have no limit. */
const MOST_TOLD: Partial<Record<TopicRole, number>> = {
  battery: 1,
  fix: 1,
  diagnostics: 1,
  text: 1,
  path: 5,
  map: 1,
  model: 1,
  joints: 20,
};
/** Topics of a table. Chosen: more than any robot here has; a page keeps readings of as many. */
export const MOST_TOPICS = 64;
/** Suffix of image_transport's topics, and their type. */
const COMPRESSED_SUFFIX = '/compressed';
const COMPRESSED_IMAGE = 'sensor_msgs/msg/CompressedImage';
const COMPRESSED_DEPTH_SUFFIX = '/compressedDepth';
/** Transforms that are valid even before they are published. */
export const STATIC_SUFFIX = '/tf_static';

/** Names that are valid in both ROS 1 and ROS 2, with the leading slash. */
const topicName = z
  .string('must be a topic name')
  .max(255, 'must be at most 255 characters long')
  .regex(/^(\/[A-Za-z_][A-Za-z0-9_]*)+$/, 'must be a complete topic name such as /camera/points');

/** `sensor_msgs/PointCloud2` or `sensor_msgs/msg/PointCloud2`; stored as the latter. */
const typeName = z
  .string('must be a message type')
  .max(255, 'must be at most 255 characters long')
  .regex(
    /^[A-Za-z][A-Za-z0-9_]*\/(msg\/)?[A-Za-z][A-Za-z0-9_]*$/,
    'must be a message type such as sensor_msgs/msg/PointCloud2',
  )
  .transform(ros2TypeOf);

const qos = z.strictObject(
  {
    reliability: z.enum(['reliable', 'best-effort'], 'must be reliable or best-effort'),
    durability: z
      .enum(['volatile', 'transient-local'], 'must be volatile or transient-local')
      .default('volatile'),
    depth: z
      .int('must be a whole number')
      .min(1, 'must be at least 1')
      .max(1000, 'must be at most 1000')
      .default(5),
  },
  { error: unknownKeys('must be reliability, durability and depth') },
);

export interface TopicEntry {
  topic: string;
  /** In ROS 2 notation. */
  type: string;
  as: TopicRole;
  /** Messages per second that are processed; `null` for no limit. */
  most: number | null;
  /** Label shown next to its values; the topic if absent. */
  label?: string | undefined;
  /** The numbers of a `text` topic that are shown over time. */
  quantities?: z.output<typeof topicQuantitiesSchema> | undefined;
  /** If absent, what the role usually needs. ROS 2 only. */
  qos?: Qos | undefined;
  /** For a type that is not part of ROS, from files: itself first. */
  definitions?: MessageDefinition[] | undefined;
}

const entry = z
  .strictObject(
    {
      topic: topicName,
      type: typeName.optional(),
      as: z.enum(roles, `must be one of ${roles.join(', ')}`),
      most: z
        .number('must be a number')
        .min(0.01, 'must be at least 0.01 messages a second')
        .max(1000, 'must be at most 1000 messages a second')
        .optional(),
      label: z
        .string('must be text')
        .min(1, 'must not be empty')
        .max(40, 'must be at most 40 characters')
        .optional(),
      quantities: topicQuantitiesSchema.optional(),
      qos: qos.optional(),
    },
    { error: unknownKeys('must be a mapping with topic and as') },
  )
  .transform((given, context): TopicEntry => {
    const types: readonly string[] = TOPIC_ROLES[given.as];
    const compressed = given.as === 'picture' && given.topic.endsWith(COMPRESSED_SUFFIX);
    const type = given.type ?? (compressed ? COMPRESSED_IMAGE : types[0]);
    if (given.as === 'picture' && given.topic.endsWith(COMPRESSED_DEPTH_SUFFIX)) {
      context.addIssue({
        code: 'custom',
        path: ['topic'],
        message: 'cannot be shown as compressedDepth: name the topic of the raw depth image',
      });
      return z.NEVER;
    }
    if (type === undefined) {
      context.addIssue({ code: 'custom', path: ['type'], message: `is needed for as: ${given.as}` });
      return z.NEVER;
    }
    if (given.quantities !== undefined && given.as !== 'text') {
      context.addIssue({
        code: 'custom',
        path: ['quantities'],
        message: `can be given for as: text only`,
      });
      return z.NEVER;
    }
    if (types.length > 0 && !types.includes(type)) {
      context.addIssue({
        code: 'custom',
        path: ['type'],
        message: `must be ${types.join(' or ')} for ${given.as}`,
      });
      return z.NEVER;
    }
    return { ...given, type, most: given.most ?? MOST_TOLD[given.as] ?? null };
  });

/** Roles that at most one topic can have. */
const SINGLE: readonly TopicRole[] = [
  'cloud',
  'depth',
  'colour',
  'cameraInfo',
  'pose',
  'battery',
  'path',
  'map',
  'model',
  'velocity',
];

/** The table in a configuration file: a list of entries. */
export const topicTableSchema = z
  .array(entry, 'must be a list of topics')
  .max(MOST_TOPICS, `must be at most ${MOST_TOPICS} topics`)
  .superRefine((entries, context) => {
    const fault = (index: number, key: string, message: string) =>
      context.addIssue({ code: 'custom', path: [index, key], message });
    const first = (role: TopicRole) => entries.findIndex(({ as }) => as === role);
    entries.forEach(({ topic, as }, index) => {
      if (as === 'picture' && entries.slice(0, index).filter((each) => each.as === as).length >= MAX_CAMERAS)
        fault(index, 'as', `there can be at most ${MAX_CAMERAS} of picture`);
      if (SINGLE.includes(as) && first(as) !== index) fault(index, 'as', `there can be only one ${as}`);
      if (entries.findIndex((each) => each.topic === topic) !== index)
        fault(index, 'topic', `${topic} is listed twice`);
    });
    if (tooManyQuantities(entries))
      context.addIssue({ code: 'custom', message: `have more than ${MAX_QUANTITIES} quantities together` });
    const depth = first('depth');
    if (depth >= 0 && first('cloud') >= 0) fault(depth, 'as', 'depth and cloud cannot both be given');
    if (depth >= 0 && first('cameraInfo') < 0) fault(depth, 'as', 'depth needs an entry cameraInfo');
    const colour = first('colour');
    if (colour >= 0 && depth < 0) fault(colour, 'as', 'colour needs an entry depth');
  });

export type TopicTable = TopicEntry[];

/** Converts `sensor_msgs/PointCloud2` of ROS 1 to `sensor_msgs/msg/PointCloud2` of ROS 2. */
export function ros2TypeOf(type: string): string {
  const parts = type.split('/');
  return parts.length === 2 ? `${parts[0]}/msg/${parts[1]}` : type;
}

/** The reverse conversion. */
export function ros1TypeOf(type: string): string {
  const parts = type.split('/');
  return parts.length === 3 ? `${parts[0]}/${parts[2]}` : type;
}

/** The only topic with a role, if there is one. */
export function topicAs(table: readonly TopicEntry[], role: TopicRole): TopicEntry | undefined {
  return table.find(({ as }) => as === role);
}

/** The QoS of a topic: from the table, else what its role needs. */
export function qosOf({ topic, as, qos }: TopicEntry): Qos {
  if (qos !== undefined) return qos;
  if (as === 'velocity') return VELOCITY_QOS;
  // Published once, for those who come later, too.
  if (as === 'map' || as === 'model') return { ...LATCHED_QOS, depth: 1 };
  if (as !== 'tf') return SENSOR_QOS;
  return topic.endsWith(STATIC_SUFFIX) ? LATCHED_QOS : { ...RELIABLE_QOS, depth: 100 };
}

function unknownKeys(otherwise: string): z.core.$ZodErrorMap {
  return (issue) =>
    issue.code === 'unrecognized_keys' ? `has unknown keys: ${issue.keys.join(', ')}` : otherwise;
}
