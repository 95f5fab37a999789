/** The thread that hears a stop topic. */
import { parentPort, workerData } from 'node:worker_threads';
import { SENSOR_QOS } from '@farpoint/ros';
import { type GraphOptions, openGraph } from '../../ground/ros/open-graph.ts';
import { saysStop } from './bool-message.ts';
import { StopCells } from './stop-cells.ts';

export interface TopicStopSetup {
  graph: GraphOptions;
  topic: string;
  cells: SharedArrayBuffer;
}

export type TopicStopReport =
  /** Another stop or go than before: look at once. */
  | { type: 'changed' }
  /** A fault that may be temporary. */
  | { type: 'fault'; detail: string }
  /** The topic cannot be heard. */
  | { type: 'failed'; detail: string };

/** How often publishers are counted, ms: a stop whose publisher has gone is soon silent. */
const LOOK_MS = 20;

const port = parentPort;
if (port === null) throw new Error('topic-stop-worker.ts runs as a worker only');
const { graph: options, topic, cells: memory } = workerData as TopicStopSetup;
const cells = new StopCells(memory);
const send = (report: TopicStopReport) => port.postMessage(report);

try {
  const graph = await openGraph(options, 'stop');
  let lastFault = '';
  graph.onFault = ({ message }) => {
    if (message !== lastFault) send({ type: 'fault', detail: message });
    lastFault = message;
  };
  let before: boolean | null = null;
  const to = { topic, type: 'std_msgs/msg/Bool', qos: SENSOR_QOS, queue: 16 };
  const subscription = graph.subscribe(to, (bytes, receivedMs) => {
    const stop = saysStop(graph.version, bytes);
    cells.setPublishers(Math.max(1, subscription.publishers));
    cells.hear(stop, receivedMs);
    if (stop !== before) send({ type: 'changed' });
    before = stop;
  });
  const looking = setInterval(() => cells.setPublishers(subscription.publishers), LOOK_MS);
  port.on('message', () => {
    clearInterval(looking);
    subscription.close();
    void graph.close().finally(() => port.close());
  });
} catch (error) {
  send({ type: 'failed', detail: error instanceof Error ? error.message : String(error) });
  port.close();
}
