/** The library’s node, extended: it knows who is already connected, and that others may end it. */

import { RosNode, type Subscription } from '@foxglove/ros1';

type NodeOptions = ConstructorParameters<typeof RosNode>[0];

export class OwnNode extends RosNode {
  /** Called when the master ends this node: by `rosnode kill`, or because another node with its name has registered. */
  onShutdown: (() => void) | null = null;
  readonly #connecting = new Set<string>();

  constructor(options: NodeOptions) {
    super(options);
    // Callers see these errors in the node’s own events; without a listener, they would be lost anyway.
    this.on('error', () => {});
  }

  override shutdown(message?: string): void {
    super.shutdown(message);
    this.onShutdown?.();
  }

  /** Does not connect twice to the same publisher: the master and the monitor may both request it. */
  override async _subscribeToPublisher(url: string, subscription: Subscription): Promise<void> {
    const key = `${subscription.name} ${url}`;
    const linked = [...subscription.publishers().values()].some((link) => link.publisherXmlRpcUrl() === url);
    if (linked || this.#connecting.has(key)) return;
    this.#connecting.add(key);
    try {
      await super._subscribeToPublisher(url, subscription);
    } finally {
      this.#connecting.delete(key);
    }
  }
}
