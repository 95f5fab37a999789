/** Receives the messages of one topic from the table. Limits their rate and reports their faults. */
import { decoderOf, qosOf, RateLimit, RosFault, type RosGraph, type TopicEntry } from '@farpoint/ros';

export interface Listener {
  readonly entry: TopicEntry;
  /** Number of messages received. */
  readonly received: number;
  readonly publishers: number;
  close(): void;
}

export interface ListenOptions {
  /** Number of messages that may wait in the graph. */
  queue: number;
  /** Whether to limit the rate, before decoding; default `true`. */
  limited?: boolean;
  onFault: (fault: RosFault) => void;
}

/** @param take gets the message, valid only during the call, and when it came; what it throws is reported as a fault */
export function listen(
  graph: RosGraph,
  entry: TopicEntry,
  options: ListenOptions,
  take: (message: unknown, receivedMs: number) => void,
): Listener {
  let decode: ((bytes: Uint8Array) => unknown) | null = null;
  return listenBytes(graph, entry, options, (bytes, receivedMs, definition) => {
    decode ??= decoderOf(graph.version, entry.type, definition ?? entry.definitions ?? null);
    take(decode(bytes), receivedMs);
  });
}

/**
 * As {@link listen}, for messages that are kept and decoded elsewhere.
 *
 * @param take gets the bytes, valid only during the call, and the publisher's description of them
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
