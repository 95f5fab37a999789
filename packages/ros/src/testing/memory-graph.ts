/** A graph within one process, for tests of code that uses graphs: bytes go from publisher to subscriber at once. */
import { MessageWriter as Ros1Writer } from '@foxglove/rosmsg-serialization';
import { MessageWriter as Ros2Writer } from '@foxglove/rosmsg2-serialization';
import { definitionsOf } from '../definitions.ts';
import type { RosFault } from '../fault.ts';
import type {
  AdvertiseAs,
  GraphTopic,
  OnMessage,
  Publisher,
  RosGraph,
  ServiceAs,
  ServiceClient,
  ServiceGraph,
  SubscribeTo,
  Subscription,
} from '../graph.ts';

export class MemoryGraph implements RosGraph {
  readonly version: 1 | 2;
  onFault: ((fault: RosFault) => void) | null = null;
  closed = false;
  /** All requested subscriptions, in order. */
  readonly subscribed: SubscribeTo[] = [];
  readonly advertised: AdvertiseAs[] = [];
  /** What was published, by topic. */
  readonly published = new Map<string, Uint8Array[]>();
  /** Additional topics that discovery should report. */
  others: GraphTopic[] = [];
  readonly #receivers = new Map<string, OnMessage>();
  readonly #now: () => number;

  constructor(version: 1 | 2, now: () => number) {
    this.version = version;
    this.#now = now;
  }

  subscribe(to: SubscribeTo, onMessage: OnMessage): Subscription {
    this.subscribed.push(to);
    let received = 0;
    this.#receivers.set(to.topic, (bytes, receivedMs) => {
      received++;
      onMessage(bytes, receivedMs);
    });
    return {
      topic: to.topic,
      get received() {
        return received;
      },
      ...{ dropped: 0, publishers: 0, definition: null },
      close: () => this.#receivers.delete(to.topic),
    };
  }

  advertise(as: AdvertiseAs): Publisher {
    this.advertised.push(as);
    const sent: Uint8Array[] = [];
    this.published.set(as.topic, sent);
    return { topic: as.topic, subscribers: 1, publish: (bytes) => sent.push(bytes.slice()), close: () => {} };
  }

  topics(): readonly GraphTopic[] {
    return this.others;
  }

  async close(): Promise<void> {
    this.closed = true;
  }

  /** Publishes a message as another node. @param reuse overwrites the bytes after the call, as a graph may */
  say(topic: string, type: string, message: unknown, { reuse = true } = {}): void {
    const bytes = messageBytes(this.version, type, message);
    this.#receivers.get(topic)?.(bytes, this.#now());
    if (reuse) bytes.fill(0xdd);
  }

  /** The same with bytes that need not be a message. */
  sayBytes(topic: string, bytes: Uint8Array): void {
    this.#receivers.get(topic)?.(bytes, this.#now());
  }
}

/** A call that waits for the test to answer it. */
export interface MemoryCall {
  service: string;
  request: Uint8Array;
  withinMs: number;
  reply(bytes: Uint8Array): void;
  fail(fault: RosFault): void;
}

/** The same with services, which do nothing by themselves. */
export class MemoryServiceGraph extends MemoryGraph implements ServiceGraph {
  readonly clients: ServiceAs[] = [];
  /** All calls, in order. */
  readonly calls: MemoryCall[] = [];
  /** Services without a server. */
  readonly absent = new Set<string>();

  constructor(now: () => number) {
    super(2, now);
  }

  serviceClient(as: ServiceAs): ServiceClient {
    this.clients.push(as);
    const { service } = as;
    const call = (request: Uint8Array, withinMs: number) =>
      new Promise<Uint8Array>((reply, fail) =>
        this.calls.push({ service, request: request.slice(), withinMs, reply, fail }),
      );
    const { absent } = this;
    return {
      service,
      get isReady() {
        return !absent.has(service);
      },
      call,
      close: () => {},
    };
  }
}

/** A message of one of ROS’s own types. */
export function messageBytes(version: 1 | 2, type: string, message: unknown): Uint8Array {
  const definitions = definitionsOf(version, type);
  if (definitions === null) throw new Error(`no such type: ${type}`);
  const writer = version === 1 ? new Ros1Writer(definitions) : new Ros2Writer(definitions);
  return writer.writeMessage(message);
}
