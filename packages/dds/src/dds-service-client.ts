import { randomBytes } from 'node:crypto';
import { RELIABLE_QOS, RosFault, type ServiceAs, type ServiceClient } from '@farpoint/ros';
import type { Addon, GraphHandle } from './addon.ts';
import { DdsPublisher } from './dds-publisher.ts';
import { DdsSubscription } from './dds-subscription.ts';
import { fromDdsType, toDdsService, toDdsType } from './ros-names.ts';
import { ServiceCalls } from './service-calls.ts';

/** While calls are open, deadlines and servers are looked at this often, ms. Chosen: people notice no less. */
const WATCH_MS = 100;
/** Requests and replies that wait. Chosen: as many calls as may be open; others’ replies pass by, too, and are dropped at once. */
const QUEUE = 64;

export interface ServiceClientEvents {
  /** Types under which others subscribe to a DDS topic. */
  typesOf(ddsTopic: string): readonly string[];
  onFault: (fault: RosFault) => void;
  onClose: (client: DdsServiceClient) => void;
  now: () => number;
}

/** Calls a service in the way of rmw_cyclonedds. */
export class DdsServiceClient implements ServiceClient {
  readonly service: string;
  readonly #requests: DdsPublisher;
  readonly #replies: DdsSubscription;
  readonly #calls: ServiceCalls;
  readonly #onClose: (client: DdsServiceClient) => void;
  #timer: NodeJS.Timeout | null = null;

  /** @throws {RosFault} for names that are not valid */
  constructor(addon: Addon, graph: GraphHandle, as: ServiceAs, events: ServiceClientEvents) {
    const { service } = as;
    this.service = service;
    this.#onClose = events.onClose;
    const { topics, request, reply } = namesOf(as);
    // Whoever serves it waits for the reader that belongs to the request’s writer.
    const userData = `clientid=${[...randomBytes(16)].map((byte) => byte.toString(16)).join('.')};`;
    const common = { topic: service, qos: { ...RELIABLE_QOS, depth: QUEUE }, userData };
    const ignore = () => undefined;
    this.#replies = new DdsSubscription(
      addon,
      graph,
      { ...common, ddsTopic: topics.reply, ddsType: reply, queue: QUEUE },
      {
        onMessage: (bytes) => this.#calls.take(bytes),
        onFault: events.onFault,
        onClose: ignore,
        now: events.now,
      },
    );
    this.#requests = new DdsPublisher(
      addon,
      graph,
      { ...common, ddsTopic: topics.request, ddsType: request },
      ignore,
    );
    const [requests, replies] = [this.#requests, this.#replies];
    const endpoints = {
      get readers() {
        return requests.matched;
      },
      get writers() {
        return replies.matched;
      },
      get otherTypes() {
        const types = events.typesOf(topics.request).filter((type) => type !== request);
        return types.map((type) => fromDdsType(type) ?? type);
      },
      write: (bytes: Uint8Array) => {
        const { refused } = requests;
        requests.publish(bytes);
        return requests.refused === refused;
      },
    };
    this.#calls = new ServiceCalls(service, randomBytes(8).readBigUInt64LE(), endpoints, events.now);
  }

  get isReady(): boolean {
    return this.#calls.isReady;
  }

  call(request: Uint8Array, withinMs: number): Promise<Uint8Array> {
    const reply = this.#calls.call(request, withinMs);
    this.#watch();
    return reply;
  }

  /** Discovery has news. */
  look(): void {
    // What has come before its server went is a reply.
    this.#replies.drain();
    this.#calls.update();
  }

  close(): void {
    if (this.#timer !== null) clearInterval(this.#timer);
    this.#timer = null;
    this.#calls.close();
    this.#requests.close();
    this.#replies.close();
    this.#onClose(this);
  }

  #watch(): void {
    if (this.#calls.open === 0) return;
    this.#timer ??= setInterval(() => {
      this.look();
      if (this.#calls.open > 0 || this.#timer === null) return;
      clearInterval(this.#timer);
      this.#timer = null;
    }, WATCH_MS);
  }
}

/** @throws {RosFault} */
function namesOf({ service, request, reply }: ServiceAs) {
  const topics = toDdsService(service);
  const [requestType, replyType] = [toDdsType(request), toDdsType(reply)];
  if (topics === null)
    throw new RosFault('unsupported', `${service} is not a complete name`, { topic: service });
  if (requestType === null || replyType === null)
    throw new RosFault('unsupported', `${request} and ${reply} are not types of a service`, {
      topic: service,
    });
  return { topics, request: requestType, reply: replyType };
}
