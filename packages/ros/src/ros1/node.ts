/** The library’s node, told what it cannot know: who is connected already, and that others may end it. */
import { RosNode, type Subscription } from '@foxglove/ros1';

type NodeOptions = ConstructorParameters<typeof RosNode>[0];

export class OwnNode extends RosNode {
  /** Called where the master ends this node: by `rosnode kill`, or as another of its name has come. */
  onShutdown: (() => void) | null = null;
  readonly #connecting = new Set<string>();

  constructor(options: NodeOptions) {
    super(options);
    // Whoever calls finds these among the node’s own events; without a listener they would be lost anyway.
    this.on('error', () => {});
  }

  override shutdown(message?: string): void {
    super.shutdown(message);
    this.onShutdown?.();
  }

  /** Not twice to the same: the master and the watch may both ask for it. */
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
