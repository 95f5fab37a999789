/**
 * The process in which rclnodejs runs: only one thread of a process may load its addon, and a crash in it must not end
 * the robot. Ends with the robot.
 */
import { createRequire } from 'node:module';
import { RosFault } from '../fault.ts';
import type { GraphTopic } from '../graph.ts';
import { checkBinary } from './native-binary.ts';
import { Outbox } from './outbox.ts';
import type { Endpoint, ProcessReport, ProcessRequest, ProcessSetup } from './process-messages.ts';
import {
  endpointsSchema,
  qosValues,
  type RclNode,
  type Rclnodejs,
  type RclPublisher,
  type RclSubscription,
  rclnodejsSchema,
  topicNamesSchema,
} from './rclnodejs-api.ts';
import { othersOf } from './topics.ts';

/** How long the node waits for work at a time, ms. Chosen: what this process is told waits no longer. */
const SPIN_MS = 10;
/** How often publishers and subscribers are counted, and topics listed, ms. Chosen: a gone publisher is soon known; listing costs more. */
const COUNTS_MS = 100;
const TOPICS_MS = 500;
/** How long the last message may take to be acknowledged, ns. */
const LAST_ACKNOWLEDGED_NS = 100_000_000n;

type Out = Outbox<{ bytes: Buffer; receivedMs: number }>;
const subscriptions = new Map<number, { rcl: RclSubscription; out: Out }>();
const publishers = new Map<number, RclPublisher>();
const report = (message: ProcessReport): void => void process.send?.(message);

/** @throws {RosFault} */
async function open({ name, entry }: ProcessSetup): Promise<{ rcl: Rclnodejs; node: RclNode }> {
  checkBinary(entry, process.env);
  const rcl = rclnodejsSchema.parse(createRequire(import.meta.url)(entry)) as unknown as Rclnodejs;
  await rcl.init();
  const options = Object.assign(new rcl.NodeOptions(), {
    startParameterServices: false,
    enableRosout: false,
  });
  const node = new rcl.Node(name, '', rcl.Context.defaultContext(), options);
  node.spin(SPIN_MS);
  return { rcl, node };
}

function serve(rcl: Rclnodejs, node: RclNode, name: string): void {
  const qosOf = ({ qos }: Endpoint) => new rcl.QoS(...qosValues(qos));
  const handlers: { [K in ProcessRequest['is']]: (request: ProcessRequest & { is: K }) => void } = {
    subscribe({ endpoint, queue }) {
      const { id, topic, type } = endpoint;
      const out: Out = new Outbox(queue, (message) => report({ is: 'message', id, ...message }));
      const add = (bytes: Buffer) => out.add({ bytes, receivedMs: Number(process.hrtime.bigint()) / 1e6 });
      const made = node.createSubscription(type, topic, { isRaw: true, qos: qosOf(endpoint) }, add);
      subscriptions.set(id, { rcl: made, out });
    },
    advertise({ endpoint }) {
      const { id, topic, type } = endpoint;
      publishers.set(id, node.createPublisher(type, topic, { qos: qosOf(endpoint) }));
    },
    publish({ id, bytes: { buffer, byteOffset, byteLength } }) {
      publishers.get(id)?.publish(Buffer.from(buffer as ArrayBuffer, byteOffset, byteLength));
    },
    taken({ id }) {
      subscriptions.get(id)?.out.taken();
    },
    remove({ id }) {
      const subscription = subscriptions.get(id);
      if (subscription !== undefined) node.destroySubscription(subscription.rcl);
      const publisher = publishers.get(id);
      publisher?.waitForAllAcked(LAST_ACKNOWLEDGED_NS);
      if (publisher !== undefined) node.destroyPublisher(publisher);
      subscriptions.delete(id);
      publishers.delete(id);
    },
    close: end,
  };
  function end(): void {
    node.destroy();
    rcl.shutdown();
    process.exit(0);
  }
  process.on('message', (request: ProcessRequest) => {
    try {
      (handlers[request.is] as (request: ProcessRequest) => void)(request);
    } catch (error) {
      const topic = 'endpoint' in request ? request.endpoint.topic : '';
      const code = 'endpoint' in request ? 'unsupported' : 'refused';
      report({ is: 'fault', code, what: (error as Error).message, topic });
    }
  });
  process.on('disconnect', end);
  setInterval(() => report({ is: 'counts', counts: [...counts()] }), COUNTS_MS);
  setInterval(() => report({ is: 'topics', topics: topicsOf(node, name) }), TOPICS_MS);
}

function* counts() {
  for (const [id, { rcl, out }] of subscriptions)
    yield { id, received: out.received, dropped: out.dropped, others: rcl.publisherCount };
  for (const [id, rcl] of publishers) yield { id, received: 0, dropped: 0, others: rcl.subscriptionCount };
}

function topicsOf(node: RclNode, own: string): GraphTopic[] {
  return topicNamesSchema.parse(node.getTopicNamesAndTypes()).flatMap(({ name: topic }) => {
    const published = endpointsSchema.parse(node.getPublishersInfoByTopic(topic, false));
    return othersOf(
      topic,
      own,
      published,
      endpointsSchema.parse(node.getSubscriptionsInfoByTopic(topic, false)),
    );
  });
}

// The robot ends this process, after the last zero velocity: systemd's signal goes to all processes at once.
for (const signal of ['SIGTERM', 'SIGINT', 'SIGHUP'] as const) process.on(signal, () => undefined);
const setup = JSON.parse(process.argv[2] ?? '') as ProcessSetup;
try {
  const { rcl, node } = await open(setup);
  process.removeAllListeners('SIGINT').on('SIGINT', () => undefined);
  serve(rcl, node, setup.name);
  report({ is: 'ready' });
} catch (error) {
  const { what, remedy } =
    error instanceof RosFault ? error : { what: (error as Error).message, remedy: undefined };
  process.send?.({ is: 'failed', what, remedy } satisfies ProcessReport, () => process.exit(1));
}
