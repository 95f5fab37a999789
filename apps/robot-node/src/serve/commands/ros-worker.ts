/** The thread that publishes commands' messages in the robot's ROS graph, calls its services, and sends goals to its action servers. */
import { parentPort, workerData } from 'node:worker_threads';
import { callsServices, type Publisher, type RosGraph } from '@farpoint/ros';
import { openGraph, tellNewFaults } from '../../ground/ros/open-graph.ts';
import type { ActionPort, ActionResult } from './command-actor.ts';
import type { CallAction, GoalAction, GraphAction, PublishAction } from './command-configuration.ts';
import { GoalClient } from './goal-client.ts';
import type { RosWorkerReport, RosWorkerRequest, RosWorkerSetup } from './ros-messages.ts';
import { Ros2GoalClient } from './ros2-goal-client.ts';
import { Ros2Services } from './ros2-services.ts';

/** The main thread says first that nothing has answered, ms. Chosen: its own timer is late by less. */
const LATER_MS = 1000;

const port = parentPort;
if (port === null) throw new Error('ros-worker.ts runs as a worker only');
const { graph: options, actions } = workerData as RosWorkerSetup;
const send = (report: RosWorkerReport) => port.postMessage(report);
const nothing = () => undefined;
const detailOf = (error: unknown) => (error instanceof Error ? error.message : String(error));

type Call = (action: CallAction, withinMs: number) => Promise<ActionResult>;
/** Starts a goal. @returns cancels it */
type Send = (action: GoalAction, port: ActionPort) => () => void;

/** Nothing needs to be there before a service of ROS 1 is called. */
async function callRos1({ service, type, data }: CallAction, withinMs: number): Promise<ActionResult> {
  if (options.kind !== 'ros1') throw new Error('this graph is not of ROS 1');
  const { callService } = await import('@farpoint/ros/ros1');
  const name = `${options.name}_commands`;
  const reply = await callService({ ...options, name }, { service, type, data }, withinMs);
  return { state: reply.success ? 'done' : 'failed', detail: reply.message };
}

/** Clients of what the commands name, which are there before the first command. */
function clientsOn(graph: RosGraph): { call: Call; send: Send } {
  const calls = actions.filter((action) => action.kind === 'call');
  const named = new Map(
    actions.filter((action) => action.kind === 'goal').map((action) => [action.action, action]),
  );
  if (graph.version === 1) {
    const name = options.name ?? 'farpoint';
    const clients = new Map([...named].map(([key, action]) => [key, new GoalClient(graph, action, name)]));
    const send: Send = ({ action, bytes }, told) =>
      clients.get(action)?.send(bytes, Date.now(), told) ?? nothing;
    return { call: callRos1, send };
  }
  if (callsServices(graph)) {
    const services = new Ros2Services(graph, calls);
    const clients = new Map([...named].map(([key, action]) => [key, new Ros2GoalClient(graph, action)]));
    const send: Send = ({ action, bytes }, told) => clients.get(action)?.send(bytes, told) ?? nothing;
    return { call: (action, withinMs) => services.call(action, withinMs), send };
  }
  const detail = 'services and actions of ROS 2 are called over DDS: set ros.graph to dds';
  const send: Send = (_, told) => {
    told.end({ state: 'failed', detail });
    return nothing;
  };
  return { call: () => Promise.reject(new Error(detail)), send };
}

/** What does the actions of one graph. */
class GraphActions {
  readonly #graph: RosGraph;
  readonly #publishers = new Map<string, Publisher>();
  readonly #clients: { call: Call; send: Send };
  readonly #cancels = new Map<number, () => void>();

  constructor(graph: RosGraph) {
    this.#graph = graph;
    // Before the first command: whoever subscribes needs time to connect.
    for (const action of actions) {
      if (action.kind === 'publish' && !this.#publishers.has(action.topic))
        this.#publishers.set(action.topic, graph.advertise({ topic: action.topic, type: action.type }));
    }
    this.#clients = clientsOn(graph);
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
      this.#clients
        .call(action, timeoutMs + LATER_MS)
        .then(end, (error: unknown) => end({ state: 'failed', detail: detailOf(error) }));
    else {
      const cancel = this.#clients.send(action, told);
      if (!hasEnded) this.#cancels.set(number, cancel);
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
