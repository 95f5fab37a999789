/**
 * A ROS 1 graph through its master. The library implements the protocol; this class monitors registrations and
 * connections, so that a master or a peer that returns is found again.
 */

import { Subscription as LibrarySubscription, Publication } from '@foxglove/ros1';
import { md5, stringify } from '@foxglove/rosmsg';
import { MessageWriter } from '@foxglove/rosmsg-serialization';
import { HttpServerNodejs } from '@foxglove/xmlrpc/nodejs';
import { definitionsOf } from '../definitions.ts';
import { RosFault } from '../fault.ts';
import type {
  AdvertiseAs,
  GraphTopic,
  OnMessage,
  Publisher,
  RosGraph,
  SubscribeTo,
  Subscription,
} from '../graph.ts';
import { ros1TypeOf, ros2TypeOf } from '../topic-table.ts';
import { Master, type MasterState } from './master.ts';
import { OwnNode } from './node.ts';
import { RosTcpServer, RosTcpSocket } from './tcp.ts';

export interface Ros1Options {
  /** The master, for example `http://localhost:11311`. */
  masterUrl: string;
  /** The node’s name, with or without a leading slash. */
  name: string;
  /** How others reach this machine: a name or an address that they know. */
  hostname: string;
}

/** How often the master is asked for the graph, ms. Chosen: one XML-RPC call a second; a master that restarts is known as soon. */
const WATCH_MS = 1000;
const LOOPBACK = ['localhost', '127.0.0.1', '::1'];

/**
 * @param now the clock of `receivedMs`, ms
 * @throws {RosFault} if no port can be opened; it waits for a master that is not running
 */
export async function openRos1Graph(options: Ros1Options, now: () => number): Promise<RosGraph> {
  return Ros1Graph.open(options, now);
}

interface OwnSubscription extends Subscription {
  /** Whether it had a publisher at the last check, and the messages received by then. */
  served: boolean;
  receivedThen: number;
  readonly type: string;
  readonly library: LibrarySubscription;
}

class Ros1Graph implements RosGraph {
  readonly version = 1;
  #onFault: ((fault: RosFault) => void) | null = null;
  /** The last fault that occurred without a listener. */
  #untold: RosFault | null = null;
  readonly #options: Ros1Options;
  readonly #now: () => number;
  readonly #node: OwnNode;
  readonly #master: Master;
  readonly #subscriptions = new Map<string, OwnSubscription>();
  readonly #publications = new Map<string, Publication>();
  /** Connections that were already missing at the last check are given up. */
  #unconnected = new Set<unknown>();
  #topics: readonly GraphTopic[] = [];
  #masterLost = false;
  #timer: NodeJS.Timeout | null = null;
  #watching: Promise<void> = Promise.resolve();
  #closed = false;
  /** Messages, such as velocities, that a subscriber did not take in time. */
  dropped = 0;

  private constructor(options: Ros1Options, now: () => number, node: OwnNode) {
    this.#options = options;
    this.#now = now;
    this.#node = node;
    this.#master = new Master(node.rosMasterClient, node.name, node.rosFollower.url() ?? '');
    node.onShutdown = () => {
      if (this.#closed) return;
      this.#fault(
        new RosFault('lost', `the master has ended the node ${node.name}`, {
          remedy: 'restart the robot; does another node have that name?',
        }),
      );
      void this.close();
    };
  }

  static async open(options: Ros1Options, now: () => number): Promise<Ros1Graph> {
    const { masterUrl, hostname: host } = options;
    const name = options.name.startsWith('/') ? options.name : `/${options.name}`;
    // A node that is reached only from this machine need not listen on the network.
    const bind = LOOPBACK.includes(host) ? '127.0.0.1' : undefined;
    let graph: Ros1Graph | null = null;
    const onDropped = () => {
      if (graph !== null) graph.dropped++;
    };
    const httpServer = new HttpServerNodejs();
    const listen = httpServer.listen.bind(httpServer);
    httpServer.listen = (port, _host, backlog) => listen(port, bind, backlog);
    try {
      const node = new OwnNode({
        name,
        hostname: host,
        pid: process.pid,
        rosMasterUri: masterUrl,
        httpServer,
        tcpSocketCreate: async ({ host: peer, port }) => RosTcpSocket.to(peer, port, onDropped),
        tcpServer: await RosTcpServer.listen(bind, onDropped),
      });
      await node.start();
      graph = new Ros1Graph(options, now, node);
    } catch (error) {
      throw new RosFault('unavailable', `no port could be opened: ${detailOf(error)}`, { cause: error });
    }
    await graph.#watch();
    graph.#timer = setInterval(() => void graph.#watch(), WATCH_MS);
    return graph;
  }

  get onFault(): ((fault: RosFault) => void) | null {
    return this.#onFault;
  }

  set onFault(listener: ((fault: RosFault) => void) | null) {
    this.#onFault = listener;
    if (listener !== null && this.#untold !== null) listener(this.#untold);
    if (listener !== null) this.#untold = null;
  }

  topics(): readonly GraphTopic[] {
    return this.#topics;
  }

  subscribe({ topic, type }: SubscribeTo, onMessage: OnMessage): Subscription {
    if (this.#subscriptions.has(topic)) throw new RosFault('refused', 'it is already subscribed', { topic });
    const dataType = ros1TypeOf(type);
    const library = new LibrarySubscription({ name: topic, md5sum: '*', dataType, tcpNoDelay: true });
    let received = 0;
    let definition: string | null = null;
    library.on('header', (header) => {
      const refusal = header.get('error');
      const theirs = header.get('type') ?? dataType;
      definition = header.get('message_definition') ?? definition;
      if (refusal !== undefined) this.#fault(new RosFault('refused', refusal, { topic }));
      else if (theirs !== dataType) {
        const what = `it has ${ros2TypeOf(theirs)}, not ${type}`;
        this.#fault(
          new RosFault('wrong-type', what, { topic, remedy: 'set its type in the table of topics' }),
        );
      }
    });
    library.on('message', (_, bytes, link) => {
      if ((link.connection.header().get('type') ?? dataType) !== dataType) return;
      received++;
      onMessage(bytes, this.#now());
    });
    this.#node.subscriptions.set(topic, library);
    const own: OwnSubscription = {
      topic,
      type: dataType,
      library,
      served: false,
      receivedThen: 0,
      get received() {
        return received;
      },
      // Each is delivered as it arrives; waiting messages stay in the kernel and with the publisher.
      dropped: 0,
      get publishers() {
        return linksOf(library).filter(({ connection }) => connection.connected()).length;
      },
      get definition() {
        return definition;
      },
      close: () => {
        if (!this.#subscriptions.delete(topic)) return;
        this.#node.subscriptions.delete(topic);
        library.close();
        this.#master.unregisterSubscriber(topic).catch(() => {});
      },
    };
    this.#subscriptions.set(topic, own);
    void this.#watch();
    return own;
  }

  advertise({ topic, type, qos, definitions: given }: AdvertiseAs): Publisher {
    const definitions = given === undefined ? definitionsOf(1, type) : [...given];
    if (definitions === null) throw new RosFault('unsupported', `publishing ${type}`, { topic });
    if (this.#publications.has(topic)) throw new RosFault('refused', 'it is already published', { topic });
    const latched = qos?.durability === 'transient-local';
    const publication = new Publication(
      topic,
      md5(definitions),
      ros1TypeOf(type),
      latched,
      definitions,
      stringify(definitions),
      new MessageWriter(definitions),
    );
    this.#publications.set(topic, publication);
    this.#node.publications.set(topic, publication);
    void this.#watch();
    return {
      topic,
      get subscribers() {
        return publication.subscribers().size;
      },
      publish: (bytes) => {
        const framed = new Uint8Array(4 + bytes.length);
        new DataView(framed.buffer).setUint32(0, bytes.length, true);
        framed.set(bytes, 4);
        void publication.write('TCPROS', framed);
      },
      close: () => {
        if (!this.#publications.delete(topic)) return;
        this.#node.publications.delete(topic);
        publication.close();
        this.#master.unregisterPublisher(topic).catch(() => {});
      },
    };
  }

  async close(): Promise<void> {
    if (this.#closed) return;
    this.#closed = true;
    if (this.#timer !== null) clearInterval(this.#timer);
    await this.#watching;
    const names = [
      [...this.#subscriptions.keys()].map((topic) => this.#master.unregisterSubscriber(topic)),
      [...this.#publications.keys()].map((topic) => this.#master.unregisterPublisher(topic)),
    ];
    // A master that is gone has forgotten them anyway.
    await Promise.allSettled(names.flat());
    for (const { library } of this.#subscriptions.values()) library.close();
    for (const publication of this.#publications.values()) publication.close();
    this.#node.subscriptions.clear();
    this.#node.publications.clear();
    this.#node.shutdown();
  }

  /** One check after the other: registers what is not registered, reconnects what is not connected. */
  #watch(): Promise<void> {
    this.#watching = this.#watching.then(() => this.#look());
    return this.#watching;
  }

  async #look(): Promise<void> {
    if (this.#closed) return;
    try {
      const state = await this.#master.state();
      this.#topics = state.topics;
      this.#masterLost = false;
      this.#untold = null;
      for (const [topic, { dataType }] of this.#publications) {
        if (!isIn(state.publishers, topic, this.#node.name))
          await this.#master.registerPublisher(topic, dataType);
      }
      for (const own of this.#subscriptions.values()) await this.#lookAfter(own, state);
    } catch (error) {
      if (this.#masterLost || this.#closed) return;
      this.#masterLost = true;
      this.#fault(
        new RosFault('lost', `no ROS 1 master at ${this.#options.masterUrl}: ${detailOf(error)}`, {
          remedy: 'start roscore, or set ros.master',
          cause: error,
        }),
      );
    }
  }

  /** @throws {Error} if the master does not answer */
  async #lookAfter(own: OwnSubscription, state: MasterState): Promise<void> {
    const { topic, type, library } = own;
    const wasServed = own.served || own.received > own.receivedThen;
    if (wasServed && own.publishers === 0) {
      this.#fault(new RosFault('lost', 'its publisher is gone', { topic }));
    }
    own.receivedThen = own.received;
    own.served = own.publishers > 0;
    for (const link of linksOf(library)) {
      if (link.connection.connected()) this.#unconnected.delete(link);
      else if (this.#unconnected.delete(link)) library.removePublisher(link.connectionId);
      else this.#unconnected.add(link);
    }
    const registered = isIn(state.subscribers, topic, this.#node.name);
    const publishers = state.publishers.get(topic)?.length ?? 0;
    if (registered && linksOf(library).length >= publishers) return;
    const urls = await this.#master.registerSubscriber(topic, type);
    // The library treats it as an update from the master and connects to publishers that are new. A publisher that is
    // unknown to a new master stays connected.
    const linked = linksOf(library)
      .filter(({ connection }) => connection.connected())
      .map((link) => link.publisherXmlRpcUrl());
    this.#node.rosFollower.emit('publisherUpdate', topic, [...new Set([...urls, ...linked])], '/master');
  }

  #fault(fault: RosFault): void {
    if (this.#onFault === null) this.#untold = fault;
    else this.#onFault(fault);
  }
}

function linksOf(subscription: LibrarySubscription) {
  return [...subscription.publishers().values()];
}

function isIn(nodes: ReadonlyMap<string, readonly string[]>, topic: string, name: string): boolean {
  return nodes.get(topic)?.includes(name) ?? false;
}

function detailOf(error: unknown): string {
  const cause = error instanceof Error && error.cause instanceof Error ? `: ${error.cause.message}` : '';
  return (error instanceof Error ? error.message : String(error)) + cause;
}
