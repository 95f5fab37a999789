/** Joins the robot's ROS graph and inspects it. */
import { RosFault, type TopicEntry, type TopicTable } from '@farpoint/ros';
import { type GraphOptions, openGraph, ros2GraphOf } from '../../ground/ros/open-graph.ts';
import type { RobotOptions } from '../robot-configuration.ts';
import { graphName, judgeHostname, judgeTopics, stopEntry } from './check-ros.ts';
import { fail, ok, type Result } from './finding.ts';

/**
 * Time that discovery has to find every topic of the table, ms. Chosen: people wait for the doctor; a topic
 * that takes longer is told as missing, and found by the robot later.
 */
const DISCOVERY_MS = 3000;
/** Between two looks whether all were found, ms. Chosen: the check ends soon after the last. */
const LOOK_MS = 100;

export interface UsedGraph {
  graph: GraphOptions;
  table: TopicEntry[];
}

/**
 * The graphs that the robot joins, each with the topics that it uses there: those of the table for source and sink, and
 * those of its video cameras.
 *
 * @param topics the topic table
 */
export function graphsOf({ sensors, sink, videos, stops }: RobotOptions, topics: TopicTable): UsedGraph[] {
  const used = new Map<string, UsedGraph>();
  const uses = (graph: GraphOptions, table: readonly TopicEntry[]) => {
    const key = JSON.stringify(graph);
    const known = used.get(key);
    const names = new Set(known?.table.map(({ topic }) => topic));
    const added = table.filter(({ topic }) => !names.has(topic));
    used.set(key, { graph, table: [...(known?.table ?? []), ...added] });
  };
  for (const { capture } of sensors) if (capture.source.kind === 'ros') uses(capture.source.graph, topics);
  if (sink.kind === 'ros') uses(sink.graph, topics);
  for (const { source } of videos) if (source.kind === 'ros') uses(source.graph, [source.entry]);
  if (stops.topic !== undefined) uses(stops.topic.graph, [stopEntry(stops.topic.topic)]);
  return [...used.values()];
}

/** Options with a different node name, because a ROS master ends the first of two nodes with the same name. */
export function asDoctor(options: GraphOptions): GraphOptions {
  return { ...options, name: `${options.name ?? 'farpoint'}_doctor` };
}

/**
 * @param own see {@link judgeTopics}
 * @param masterMs time limit for an answer from the ROS 1 master
 */
export async function checkRos(
  options: GraphOptions,
  table: TopicTable,
  own: number,
  masterMs: number,
): Promise<Result[]> {
  const name = graphName(options);
  if (options.kind === 'ros1') {
    const fault = await askMaster(options.masterUrl, masterMs);
    if (fault !== null)
      return [
        fail(`${name}: ${fault}`, 'start it (`roscore`), or set ROS_MASTER_URI or ros.master to its address'),
      ];
  }
  try {
    const graph = await openGraph(asDoctor(options), 'capture');
    const deadline = performance.now() + DISCOVERY_MS;
    const complete = () => judgeTopics(table, graph.topics(), own).every(({ verdict }) => verdict === 'ok');
    while (!complete() && performance.now() < deadline)
      await new Promise((resolve) => setTimeout(resolve, LOOK_MS));
    const seen = graph.topics();
    void graph.close();
    return [
      ok(`${name}${carriedBy(options)}: ${seen.length} topics`),
      ...judgeHostname(options),
      ...judgeTopics(table, seen, own),
    ];
  } catch (error) {
    const { what, remedy } =
      error instanceof RosFault ? error : { what: (error as Error).message, remedy: undefined };
    return [fail(`${name}: ${what}`, remedy ?? 'docs/ros.md lists what is needed')];
  }
}

function carriedBy(options: GraphOptions): string {
  if (options.kind === 'ros1') return '';
  return ros2GraphOf(options) === 'dds' ? ', DDS' : `, rclnodejs with ROS ${process.env.ROS_DISTRO}`;
}

/** @returns what is wrong with the master; `null` if nothing is */
async function askMaster(url: string, withinMs: number): Promise<string | null> {
  const call =
    '<?xml version="1.0"?><methodCall><methodName>getPid</methodName><params><param><value><string>/farpoint_doctor</string></value></param></params></methodCall>';
  try {
    const answer = await fetch(url, {
      method: 'POST',
      body: call,
      headers: { 'content-type': 'text/xml' },
      signal: AbortSignal.timeout(withinMs),
    });
    return (await answer.text()).includes('<methodResponse>')
      ? null
      : 'what answers there is not a ROS master';
  } catch (error) {
    const { cause, name, message } = error as Error;
    if (name === 'TimeoutError') return 'it does not answer';
    return (cause as NodeJS.ErrnoException | undefined)?.code ?? message;
  }
}
