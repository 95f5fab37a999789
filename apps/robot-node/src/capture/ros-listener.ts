/** Messages of one topic of the table: no more of them than it allows, what is wrong with them said. */
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
  /** Limit them, before they are decoded; default `true`. */
  limited?: boolean;
  onFault: (fault: RosFault) => void;
}

/** @param take gets the message, good only during the call; what it throws is told as a fault */
export function listen(
  graph: RosGraph,
  entry: TopicEntry,
  options: ListenOptions,
  take: (message: unknown) => void,
): Listener {
  let decode: ((bytes: Uint8Array) => unknown) | null = null;
  return listenBytes(graph, entry, options, (bytes, _, definition) => {
    decode ??= decoderOf(graph.version, entry.type, definition ?? entry.definitions ?? null);
    take(decode(bytes));
  });
}

/**
 * The same of messages that are kept, and decoded where they are kept.
 *
 * @param take gets the bytes, good only during the call, and what the publisher says that they are
 */
export function listenBytes(
  graph: RosGraph,
  entry: TopicEntry,
  { queue, limited = true, onFault }: ListenOptions,
  take: (bytes: Uint8Array, receivedMs: number, definition: string | null) => void,
): Listener {
  const { topic, type } = entry;
  const limit = new RateLimit(entry.most);
  const subscription = graph.subscribe({ topic, type, qos: qosOf(entry), queue }, (bytes, receivedMs) => {
    if (limited && !limit.admits(receivedMs)) return;
    try {
      take(bytes, receivedMs, subscription.definition);
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
