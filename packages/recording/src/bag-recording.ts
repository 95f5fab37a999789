import { lazyDecoder, ros2TypeOf } from '@farpoint/ros';
import { Bag } from '@foxglove/rosbag';
import { bagDecompressors } from './decompress.ts';
import { RecordingError } from './errors.ts';
import type { FileBytes } from './file-bytes.ts';
import { asRecordingError } from './mcap-indexed.ts';
import type { RecordedMessage, RecordedTopic, Recording } from './recording.ts';

interface Time {
  sec: number;
  nsec: number;
}

/** A ROS 1 bag (version 2.0), read by its index. */
export class BagRecording implements Recording {
  readonly file: string;
  readonly topics: readonly RecordedTopic[];
  readonly startNs: bigint;
  readonly endNs: bigint;
  readonly warning = null;
  readonly #bytes: FileBytes;
  readonly #bag: Bag;
  readonly #topicOfConnection = new Map<number, RecordedTopic>();

  private constructor(bytes: FileBytes, bag: Bag) {
    this.file = bytes.path;
    this.#bytes = bytes;
    this.#bag = bag;
    const counts = new Map<number, number>();
    for (const { connections } of bag.chunkInfos) {
      for (const { conn, count } of connections) counts.set(conn, (counts.get(conn) ?? 0) + count);
    }
    for (const [id, { topic, type, messageDefinition }] of bag.connections) {
      this.#topicOfConnection.set(id, {
        name: topic,
        type: ros2TypeOf(type ?? ''),
        messages: counts.get(id) ?? 0,
        decode: lazyDecoder({
          name: type ?? '',
          messageEncoding: 'ros1',
          schemaEncoding: 'ros1msg',
          schema: new TextEncoder().encode(messageDefinition),
        }),
      });
    }
    this.topics = [...this.#topicOfConnection.values()];
    this.startNs = toNs(bag.startTime ?? { sec: 0, nsec: 0 });
    this.endNs = toNs(bag.endTime ?? { sec: 0, nsec: 0 });
  }

  /** @throws {RecordingError} if it cannot be read, or was not closed */
  static async open(bytes: FileBytes): Promise<BagRecording> {
    const { lz4, bz2 } = await bagDecompressors();
    const bag = new Bag(
      { size: () => bytes.size, read: (offset, length) => bytes.read(offset, length) },
      { parse: false, decompress: { lz4, bz2 } },
    );
    try {
      await bag.open();
    } catch (error) {
      throw asRecordingError(error, bytes);
    }
    if (bag.header?.indexPosition === 0) {
      throw new RecordingError('not-indexed', 'its recorder was killed; run `rosbag reindex` on it', {
        file: bytes.path,
        offset: 0,
      });
    }
    return new BagRecording(bytes, bag);
  }

  async *messages(topics: readonly string[], fromNs: bigint): AsyncGenerator<RecordedMessage, void, void> {
    const start = fromNs > this.startNs ? fromNs : this.startNs;
    try {
      for await (const message of this.#bag.messageIterator({ topics: [...topics], start: toTime(start) })) {
        const topic = this.#topicOfConnection.get(message.connectionId);
        if (topic === undefined) continue;
        yield { topic, logNs: toNs(message.timestamp), data: message.data, offset: this.#bytes.lastOffset };
      }
    } catch (error) {
      throw asRecordingError(error, this.#bytes);
    }
  }

  close(): Promise<void> {
    return this.#bytes.close();
  }
}

function toNs({ sec, nsec }: Time): bigint {
  return BigInt(sec) * 1_000_000_000n + BigInt(nsec);
}

function toTime(ns: bigint): Time {
  return { sec: Number(ns / 1_000_000_000n), nsec: Number(ns % 1_000_000_000n) };
}
