/** The thread that publishes commands' messages in the robot's ROS graph, calls its services, and sends goals to its action servers. */
import { parentPort, workerData } from 'node:worker_threads';
import type { Publisher, RosGraph } from '@farpoint/ros';
import { openGraph, tellNewFaults } from '../../ground/ros/open-graph.ts';
import type { ActionPort, ActionResult } from './command-actor.ts';
import type { CallAction, GraphAction, PublishAction } from './command-configuration.ts';
import { GoalClient } from './goal-client.ts';
import type { RosWorkerReport, RosWorkerRequest, RosWorkerSetup } from './ros-messages.ts';

/** The main thread says first that nothing has answered, ms. Chosen: its own timer is late by less. */
const LATER_MS = 1000;

const port = parentPort;
if (port === null) throw new Error('ros-worker.ts runs as a worker only');
const { graph: options, actions } = workerData as RosWorkerSetup;
const send = (report: RosWorkerReport) => port.postMessage(report);
const detailOf = (error: unknown) => (error instanceof Error ? error.message : String(error));

async function call({ service, type, data }: CallAction, timeoutMs: number): Promise<ActionResult> {
  if (options.kind !== 'ros1') throw new Error('services are called in ROS 1 graphs only');
  const { callService } = await import('@farpoint/ros/ros1');
  const name = `${options.name}_commands`;
  const reply = await callService({ ...options, name }, { service, type, data }, timeoutMs + LATER_MS);
  return { state: reply.success ? 'done' : 'failed', detail: reply.message };
}

/** What does the actions of one graph. */
class GraphActions {
  readonly #graph: RosGraph;
  readonly #publishers = new Map<string, Publisher>();
  readonly #goals = new Map<string, GoalClient>();
  readonly #cancels = new Map<number, () => void>();

  constructor(graph: RosGraph) {
    this.#graph = graph;
    // Before the first command: whoever subscribes needs time to connect.
    for (const action of actions) {
      if (action.kind === 'publish' && !this.#publishers.has(action.topic))
        this.#publishers.set(action.topic, graph.advertise({ topic: action.topic, type: action.type }));
      else if (action.kind === 'goal' && !this.#goals.has(action.action))
        this.#goals.set(action.action, new GoalClient(graph, action, options.name ?? 'farpoint'));
    }
  }

  begin(number: number, action: GraphAction, timeoutMs: number): void {
    let hasEnded = false;
    const end = (result: ActionResult) => {
      hasEnded = true;
      this.#cancels.delete(number);
      send({ type: 'end', number, result });
    };
    const told: ActionPort = { progress: (_, detail) => send({ type: 'progress', number, detail }), end };
    if (action.kind === 'publish') end(this.#publish(action));
    else if (action.kind === 'call')
      call(action, timeoutMs).then(end, (error: unknown) =>
        end({ state: 'failed', detail: detailOf(error) }),
      );
    else {
      const cancel = this.#goals.get(action.action)?.send(action.bytes, Date.now(), told);
      if (cancel !== undefined && !hasEnded) this.#cancels.set(number, cancel);
    }
  }

  cancel(number: number): void {
    this.#cancels.get(number)?.();
  }

  async close(): Promise<void> {
    for (const cancel of this.#cancels.values()) cancel();
    await this.#graph.close();
  }

  #publish({ topic, bytes }: PublishAction): ActionResult {
    const publisher = this.#publishers.get(topic);
    if (publisher === undefined || publisher.subscribers === 0)
      return { state: 'failed', detail: `nothing subscribes to ${topic}` };
    publisher.publish(bytes);
    return { state: 'done', detail: '' };
  }
}

try {
  const graph = await openGraph(options, 'commands');
  tellNewFaults(graph, (detail) => send({ type: 'fault', detail }));
  const open = new GraphActions(graph);
  port.on('message', (request: RosWorkerRequest) => {
    if (request.type === 'begin') open.begin(request.number, request.action, request.timeoutMs);
    else if (request.type === 'cancel') open.cancel(request.number);
    else void open.close().finally(() => port.close());
  });
} catch (error) {
  send({ type: 'fault', detail: detailOf(error) });
  port.close();
}
