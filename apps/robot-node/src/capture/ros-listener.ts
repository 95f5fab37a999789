/** Messages of one topic of the table: decoded, no more of them than it allows, what is wrong with them said. */
import { decoderOf, qosOf, RateLimit, RosFault, type RosGraph, type TopicEntry } from '@farpoint/ros';

export interface Listener {
  readonly entry: TopicEntry;
  /** Messages that came. */
  readonly received: number;
  readonly publishers: number;
  close(): void;
}

export interface ListenOptions {
  /** Messages that may wait in the graph. */
  queue: number;
  /** Limit them before they are decoded; default `true`. */
  limited?: boolean;
  onFault: (fault: RosFault) => void;
}

/** @param take gets the message and its bytes, both good only during the call; what it throws is told as a fault */
export function listen(
  graph: RosGraph,
  entry: TopicEntry,
  { queue, limited = true, onFault }: ListenOptions,
  take: (message: unknown, bytes: Uint8Array, receivedMs: number) => void,
): Listener {
  const { topic, type } = entry;
  const limit = new RateLimit(entry.most);
  let decode: ((bytes: Uint8Array) => unknown) | null = null;
  const subscription = graph.subscribe({ topic, type, qos: qosOf(entry), queue }, (bytes, receivedMs) => {
    if (limited && !limit.admits(receivedMs)) return;
    try {
      decode ??= decoderOf(graph.version, type, subscription.definition);
      take(decode(bytes), bytes, receivedMs);
    } catch (error) {
      onFault(RosFault.of(error, topic));
    }
  });
  return {
    entry,
    get received() {
      return subscription.received;
    },
    get publishers() {
      return subscription.publishers;
    },
    close: () => subscription.close(),
  };
}
