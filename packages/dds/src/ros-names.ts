/**
 * DDS names of ROS 2 names: topic `/cmd_vel` is `rt/cmd_vel`, type `geometry_msgs/msg/Twist` is
 * `geometry_msgs::msg::dds_::Twist_`. Source: the ROS 2 design article “Topic and Service name mapping to DDS”.
 */

const TOPIC_PREFIX = 'rt';
/** A fully qualified name: with a leading slash, no tokens, no doubled or trailing slash. */
const TOPIC = /^(\/[A-Za-z_][A-Za-z0-9_]*)+$/;
const TYPE = /^([A-Za-z][A-Za-z0-9_]*)\/(msg|srv|action)\/([A-Za-z][A-Za-z0-9_]*)$/;
const DDS_TYPE = /^([A-Za-z][A-Za-z0-9_]*)::(msg|srv|action)::dds_::([A-Za-z][A-Za-z0-9_]*)_$/;
/** The longest name that DDS implementations accept. */
const LONGEST = 255;

/** @returns `null` if it is not a fully qualified topic name */
export function toDdsTopic(topic: string): string | null {
  const name = `${TOPIC_PREFIX}${topic}`;
  return TOPIC.test(topic) && name.length <= LONGEST ? name : null;
}

/** @returns the topics of a service’s requests and replies; `null` if it is not a fully qualified name */
export function toDdsService(service: string): { request: string; reply: string } | null {
  const [request, reply] = [`rq${service}Request`, `rr${service}Reply`];
  return TOPIC.test(service) && request.length <= LONGEST ? { request, reply } : null;
}

/** @returns `null` if it is no ROS topic but a service's, or that of a program without ROS */
export function fromDdsTopic(name: string): string | null {
  if (!name.startsWith(`${TOPIC_PREFIX}/`)) return null;
  const topic = name.slice(TOPIC_PREFIX.length);
  return TOPIC.test(topic) ? topic : null;
}

/** @returns `null` if it is not a type name such as `geometry_msgs/msg/Twist` */
export function toDdsType(type: string): string | null {
  const [, pkg, kind, name] = TYPE.exec(type) ?? [];
  const dds = `${pkg}::${kind}::dds_::${name}_`;
  return name !== undefined && dds.length <= LONGEST ? dds : null;
}

/** @returns `null` if it is no ROS type */
export function fromDdsType(name: string): string | null {
  const [, pkg, kind, type] = DDS_TYPE.exec(name) ?? [];
  return type === undefined ? null : `${pkg}/${kind}/${type}`;
}
