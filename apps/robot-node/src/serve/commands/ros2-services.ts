/** The services of a ROS 2 graph that commands call. */
import {
  readStdServiceReply,
  type ServiceClient,
  type ServiceGraph,
  stdServiceRequest,
  stdServiceTypes,
} from '@farpoint/ros';
import type { ActionResult } from './command-actor.ts';
import type { CallAction } from './command-configuration.ts';

export class Ros2Services {
  readonly #clients = new Map<string, ServiceClient>();

  /** @param calls all that are ever called: a server needs time to be found @throws {RosFault} */
  constructor(graph: ServiceGraph, calls: readonly CallAction[]) {
    for (const { service, type } of calls) {
      if (!this.#clients.has(service))
        this.#clients.set(service, graph.serviceClient({ service, ...stdServiceTypes(type) }));
    }
  }

  /** @throws {RosFault} (the promise rejects) as `ServiceClient.call`, and `bad-message` */
  async call({ service, type, data }: CallAction, withinMs: number): Promise<ActionResult> {
    const client = this.#clients.get(service);
    if (client === undefined) return { state: 'failed', detail: `${service} is not configured` };
    const reply = readStdServiceReply(type, await client.call(stdServiceRequest(type, data), withinMs));
    return { state: reply.success ? 'done' : 'failed', detail: reply.message };
  }
}
