/** The thread that publishes commands' messages in the robot's ROS graph, and calls its services. */
import { parentPort, workerData } from 'node:worker_threads';
import { openGraph } from '../ros/open-graph.ts';
import { tellNewFaults } from '../ros/tell-new-faults.ts';
import type { CallAction, PublishAction } from './command-configuration.ts';
import type { CommandWorkerReport, CommandWorkerRequest, CommandWorkerSetup } from './command-messages.ts';

/** The main thread says first that nothing has answered, ms. */
const LATER_MS = 1000;

const port = parentPort;
if (port === null) throw new Error('command-worker.ts runs as a worker only');
const { graph: options, publishes } = workerData as CommandWorkerSetup;
const send = (report: CommandWorkerReport) => port.postMessage(report);
const detailOf = (error: unknown) => (error instanceof Error ? error.message : String(error));

async function call({ service, type, data }: CallAction, timeoutMs: number) {
  if (options.kind !== 'ros1') throw new Error('services are called in ROS 1 graphs only');
  const { callService } = await import('@farpoint/ros/ros1');
  const name = `${options.name}_commands`;
  const reply = await callService({ ...options, name }, { service, type, data }, timeoutMs + LATER_MS);
  return { done: reply.success, detail: reply.message };
}

try {
  const graph = await openGraph(options, 'commands');
  tellNewFaults(graph, (detail) => send({ type: 'fault', detail }));
  // Before the first command: whoever subscribes needs time to connect.
  const publishers = new Map(publishes.map(({ topic, type }) => [topic, { topic, type }] as const));
  const open = new Map([...publishers.values()].map((as) => [as.topic, graph.advertise(as)] as const));
  const publish = ({ topic, bytes }: PublishAction) => {
    const publisher = open.get(topic);
    if (publisher === undefined || publisher.subscribers === 0)
      return { done: false, detail: `nothing subscribes to ${topic}` };
    publisher.publish(bytes);
    return { done: true, detail: '' };
  };
  port.on('message', (request: CommandWorkerRequest) => {
    if (request.type === 'act') {
      const { number, action, timeoutMs } = request;
      const answer = (result: { done: boolean; detail: string }) => send({ type: 'result', number, result });
      if (action.kind === 'publish') answer(publish(action));
      else
        call(action, timeoutMs).then(answer, (error: unknown) =>
          answer({ done: false, detail: detailOf(error) }),
        );
      return;
    }
    for (const publisher of open.values()) publisher.close();
    void graph.close().finally(() => port.close());
  });
} catch (error) {
  send({ type: 'fault', detail: detailOf(error) });
  port.close();
}
