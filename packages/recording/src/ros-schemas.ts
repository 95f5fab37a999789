/** Definitions of the ROS 2 messages in our recordings, as `ros2msg` schemas: each text contains all that it needs. */

const SEPARATOR = `\n${'='.repeat(80)}\n`;
const TIME = 'MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec';
const HEADER = 'MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id';
const VECTOR3 = 'MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z';
const QUATERNION = 'MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w';
const TWIST = 'MSG: geometry_msgs/Twist\nVector3 linear\nVector3 angular';

function schema(...definitions: string[]): string {
  return definitions.join(SEPARATOR);
}

export const POINT_CLOUD2_SCHEMA = schema(
  [
    'std_msgs/Header header',
    'uint32 height',
    'uint32 width',
    'PointField[] fields',
    'bool is_bigendian',
    'uint32 point_step',
    'uint32 row_step',
    'uint8[] data',
    'bool is_dense',
  ].join('\n'),
  'MSG: sensor_msgs/PointField\nstring name\nuint32 offset\nuint8 datatype\nuint32 count',
  HEADER,
  TIME,
);

/** As in the first version of Foxglove’s schemas; later versions append fields. */
export const FOXGLOVE_COMPRESSED_IMAGE_SCHEMA = schema(
  'builtin_interfaces/Time timestamp\nstring frame_id\nuint8[] data\nstring format',
  TIME,
);

export const FOXGLOVE_COMPRESSED_VIDEO_SCHEMA = schema(
  'builtin_interfaces/Time timestamp\nstring frame_id\nuint8[] data\nstring format',
  TIME,
);

/** As in ROS 2's diagnostic_msgs, without its comments. */
export const DIAGNOSTIC_ARRAY_SCHEMA = schema(
  'std_msgs/Header header\nDiagnosticStatus[] status',
  [
    'MSG: diagnostic_msgs/DiagnosticStatus',
    'byte OK=0',
    'byte WARN=1',
    'byte ERROR=2',
    'byte STALE=3',
    'byte level',
    'string name',
    'string message',
    'string hardware_id',
    'KeyValue[] values',
  ].join('\n'),
  'MSG: diagnostic_msgs/KeyValue\nstring key\nstring value',
  HEADER,
  TIME,
);

/** A quantity's value at the header's time. The channel's metadata says which quantity it is. */
export const SAMPLE_SCHEMA = schema('std_msgs/Header header\nfloat64 value', HEADER, TIME);

/** An alarm that has had this level since the header's time: `ok`, `warn` or `error`. */
export const ALARM_SCHEMA = schema(
  [
    'std_msgs/Header header',
    'string level',
    'string text',
    'float64 value',
    'float64 limit',
    'string unit',
  ].join('\n'),
  HEADER,
  TIME,
);

/** A line of a log, which Foxglove lists. */
export const FOXGLOVE_LOG_SCHEMA = schema(
  [
    'builtin_interfaces/Time timestamp',
    ...['uint8 level', 'string message', 'string name', 'string file', 'uint32 line'],
  ].join('\n'),
  TIME,
);

export const TF_MESSAGE_SCHEMA = schema(
  'geometry_msgs/TransformStamped[] transforms',
  'MSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring child_frame_id\nTransform transform',
  'MSG: geometry_msgs/Transform\nVector3 translation\nQuaternion rotation',
  VECTOR3,
  QUATERNION,
  HEADER,
  TIME,
);

export const TWIST_STAMPED_SCHEMA = schema(
  'std_msgs/Header header\nTwist twist',
  TWIST,
  VECTOR3,
  HEADER,
  TIME,
);

export const ODOMETRY_SCHEMA = schema(
  [
    'std_msgs/Header header',
    'string child_frame_id',
    'geometry_msgs/PoseWithCovariance pose',
    'geometry_msgs/TwistWithCovariance twist',
  ].join('\n'),
  'MSG: geometry_msgs/PoseWithCovariance\nPose pose\nfloat64[36] covariance',
  'MSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation',
  'MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z',
  'MSG: geometry_msgs/TwistWithCovariance\nTwist twist\nfloat64[36] covariance',
  TWIST,
  VECTOR3,
  QUATERNION,
  HEADER,
  TIME,
);
