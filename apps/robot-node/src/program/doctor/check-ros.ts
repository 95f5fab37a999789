/** Compares a ROS graph with the topics that the robot is to use. */
import { type GraphTopic, type TopicEntry, type TopicTable, topicTableSchema } from '@farpoint/ros';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import { fail, ok, type Result, warn } from './finding.ts';

/** Without these topics there is no cloud. */
const NEEDED: readonly TopicEntry['as'][] = ['cloud', 'depth', 'cameraInfo'];

const STOP_LABEL = 'Stop at the robot';

/** The topic of a stop, as an entry of the table. */
export function stopEntry(topic: string): TopicEntry {
  const [entry] = topicTableSchema.parse([{ topic, type: 'std_msgs/Bool', as: 'text', label: STOP_LABEL }]);
  return entry as TopicEntry;
}

/** Whether the robot shows nothing, or does not move, without the topic. */
function isNeeded({ as, label }: TopicEntry): boolean {
  return NEEDED.includes(as) || label === STOP_LABEL;
}

/**
 * @param seen the topics that discovery has found
 * @param own number of the robot's own velocity publishers: one while the robot runs
 */
export function judgeTopics(table: TopicTable, seen: readonly GraphTopic[], own: number): Result[] {
  return table.map((entry) => {
    const { topic, type, as } = entry;
    const found = seen.filter((each) => each.topic === topic);
    const same = found.find((each) => each.type === type);
    const other = found.find((each) => each.type !== type);
    if (as === 'velocity') return judgeVelocity(entry, same, other, own);
    const publishers = same?.publishers ?? 0;
    if (publishers > 0)
      return ok(`${topic} (${as}): ${publishers === 1 ? 'published' : `${publishers} publishers`}`);
    const bad = isNeeded(entry) ? fail : warn;
    if (other !== undefined)
      return bad(
        `${topic} (${as}) is of type ${other.type}, not ${type}`,
        'set its type in topics, or name another topic',
      );
    return bad(
      `${topic} (${as}): nobody publishes it`,
      `start its node, or correct the topic name${alike(topic, seen)}`,
    );
  });
}

function judgeVelocity(
  { topic, type }: TopicEntry,
  same: GraphTopic | undefined,
  other: GraphTopic | undefined,
  own: number,
): Result {
  const others = (same?.publishers ?? 0) - own;
  if ((same?.subscribers ?? 0) === 0) {
    return other !== undefined && other.subscribers > 0
      ? fail(`${topic} (velocity) is read as ${other.type}, not ${type}`, `set type: ${other.type} in topics`)
      : warn(`${topic} (velocity): nobody subscribes`, 'start the base’s driver; without it nothing moves');
  }
  if (others > 0)
    return warn(
      `${topic} (velocity) is also published by ${others} other nodes`,
      'let twist_mux choose between them: give each its own topic',
    );
  return ok(`${topic} (velocity): subscribed`);
}

/** Topics with the same last name, because these are usually what was meant. */
function alike(topic: string, seen: readonly GraphTopic[]): string {
  const last = topic.slice(topic.lastIndexOf('/'));
  const near = seen
    .filter((each) => each.topic.endsWith(last) && each.publishers > 0)
    .map((each) => each.topic);
  return near.length === 0 ? '' : ` (there is ${near.slice(0, 3).join(', ')})`;
}

/** The requested graph, as text for people. */
export function graphName(options: GraphOptions): string {
  return options.kind === 'ros1'
    ? `ROS 1, master ${options.masterUrl}`
    : `ROS 2, domain ${options.domain ?? process.env.ROS_DOMAIN_ID ?? '0'}`;
}

/** Other nodes connect to the address that we announce. */
export function judgeHostname(options: GraphOptions): Result[] {
  if (options.kind !== 'ros1') return [];
  const local = (host: string) => /^(localhost|127\.|\[?::1)/.test(host);
  if (!local(options.hostname) || local(new URL(options.masterUrl).hostname)) return [];
  return [
    fail(
      `nodes on other machines are told to reach this robot at ${options.hostname}`,
      'set ROS_IP or ros.hostname to an address that they can reach',
    ),
  ];
}
