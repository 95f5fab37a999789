/** The thread that says on a topic whether the robot drives back by itself. */
import { parentPort, workerData } from 'node:worker_threads';
import { type GraphOptions, openGraph } from '../../ground/ros/open-graph.ts';
import { boolMessage } from '../stops/bool-message.ts';

export interface AnnounceSetup {
  graph: GraphOptions;
  topic: string;
  isActive: boolean;
}

export type AnnounceRequest = { type: 'active'; isActive: boolean } | { type: 'close' };
export interface AnnounceReport {
  fault: string;
}

/**
 * Repeated, for nodes that come later, ms. Chosen: a lamp or horn follows within half of a second
 * (docs/return.md).
 */
const REPEAT_MS = 500;

const port = parentPort;
if (port === null) throw new Error('announce-worker.ts runs as a worker only');
const setup = workerData as AnnounceSetup;
const send = (report: AnnounceReport) => port.postMessage(report);

try {
  const graph = await openGraph(setup.graph, 'return');
  let lastFault = '';
  graph.onFault = ({ message }) => {
    if (message !== lastFault) send({ fault: message });
    lastFault = message;
  };
  const publisher = graph.advertise({ topic: setup.topic, type: 'std_msgs/msg/Bool' });
  let { isActive } = setup;
  const say = () => publisher.publish(boolMessage(graph.version, isActive));
  const repeating = setInterval(say, REPEAT_MS);
  port.on('message', (request: AnnounceRequest) => {
    if (request.type === 'active') {
      isActive = request.isActive;
      say();
      return;
    }
    clearInterval(repeating);
    publisher.close();
    void graph.close().finally(() => port.close());
  });
} catch (error) {
  send({ fault: error instanceof Error ? error.message : String(error) });
  port.close();
}
