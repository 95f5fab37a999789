/** As much of a ROS 1 master as nodes of this package need to find each other, for tests without ROS. */
import { XmlRpcServer, type XmlRpcValue } from '@foxglove/xmlrpc';
import { HttpServerNodejs } from '@foxglove/xmlrpc/nodejs';

type Nodes = Map<string, Map<string, string>>;

export class SmallMaster {
  readonly url: string;
  readonly #server: XmlRpcServer;
  readonly #types = new Map<string, string>();
  /** By topic: nodes with their addresses. */
  readonly #publishers: Nodes = new Map();
  readonly #subscribers: Nodes = new Map();

  private constructor(server: XmlRpcServer, url: string) {
    this.#server = server;
    this.url = url;
    const nodesOf = (nodes: Nodes, topic: string) => nodes.get(topic) ?? new Map<string, string>();
    const add = (nodes: Nodes, topic: string, name: string, api: string) =>
      nodes.set(topic, nodesOf(nodes, topic).set(name, api));
    const states = (nodes: Nodes) => [...nodes].map(([topic, own]) => [topic, [...own.keys()]]);
    this.#answer('getSystemState', () => [states(this.#publishers), states(this.#subscribers), []]);
    this.#answer('getTopicTypes', () => [...this.#types]);
    this.#answer('registerPublisher', (name = '', topic = '', type = '', api = '') => {
      this.#types.set(topic, type);
      add(this.#publishers, topic, name, api);
      return [...nodesOf(this.#subscribers, topic).values()];
    });
    this.#answer('registerSubscriber', (name = '', topic = '', _ = '', api = '') => {
      add(this.#subscribers, topic, name, api);
      return [...nodesOf(this.#publishers, topic).values()];
    });
    this.#answer('unregisterPublisher', (name = '', topic = '') =>
      Number(nodesOf(this.#publishers, topic).delete(name)),
    );
    this.#answer('unregisterSubscriber', (name = '', topic = '') =>
      Number(nodesOf(this.#subscribers, topic).delete(name)),
    );
    server.setHandler('lookupService', async () => [-1, 'no provider', 0]);
  }

  static async open(): Promise<SmallMaster> {
    const http = new HttpServerNodejs();
    const server = new XmlRpcServer(http);
    await server.listen(0, '127.0.0.1');
    return new SmallMaster(server, `http://127.0.0.1:${new URL(server.url() ?? '').port}`);
  }

  close(): void {
    this.#server.close();
  }

  #answer(method: string, act: (...args: string[]) => unknown): void {
    this.#server.setHandler(method, async (_, args) => [1, '', act(...args.map(String)) as XmlRpcValue]);
  }
}
