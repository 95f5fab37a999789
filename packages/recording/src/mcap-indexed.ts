import { McapIndexedReader } from '@mcap/core';
import { mcapDecompressors } from './decompress.ts';
import { detailOf, RecordingError } from './errors.ts';
import type { FileBytes } from './file-bytes.ts';
import { topicsOf } from './mcap-topics.ts';
import type { RecordedMessage, RecordedTopic, Recording } from './recording.ts';

/** Size of the cache of index entries, so that a seek does not read them again. */
const INDEX_CACHE_BYTES = 16 * 1024 * 1024;

/** A closed MCAP file: read by its index, chunk by chunk. */
export class IndexedMcap implements Recording {
  readonly file: string;
  readonly topics: readonly RecordedTopic[];
  readonly startNs: bigint;
  readonly endNs: bigint;
  readonly warning = null;
  readonly #bytes: FileBytes;
  readonly #reader: McapIndexedReader;
  readonly #topicOfChannel: ReadonlyMap<number, RecordedTopic>;

  private constructor(bytes: FileBytes, reader: McapIndexedReader) {
    this.file = bytes.path;
    this.#bytes = bytes;
    this.#reader = reader;
    const counts = reader.statistics?.channelMessageCounts;
    const { topics, byChannel } = topicsOf(
      reader.channelsById.values(),
      reader.schemasById,
      counts === undefined ? null : (id) => Number(counts.get(id) ?? 0n),
    );
    this.topics = topics;
    this.#topicOfChannel = byChannel;
    const chunks = reader.chunkIndexes;
    const ofChunks = timeRange(chunks.flatMap((chunk) => [chunk.messageStartTime, chunk.messageEndTime]));
    this.startNs = reader.statistics?.messageStartTime ?? ofChunks.first;
    this.endNs = reader.statistics?.messageEndTime ?? ofChunks.last;
  }

  /** @throws {RecordingError} if there is no index, or it cannot be read */
  static async open(bytes: FileBytes): Promise<IndexedMcap> {
    try {
      const reader = await McapIndexedReader.Initialize({
        readable: {
          size: async () => BigInt(bytes.size),
          read: (offset, size) => bytes.read(Number(offset), Number(size)),
        },
        decompressHandlers: mcapDecompressors,
        messageIndexCacheSizeBytes: INDEX_CACHE_BYTES,
      });
      const missing = missingOf(reader);
      if (missing !== null) throw new RecordingError('not-indexed', missing, { file: bytes.path });
      return new IndexedMcap(bytes, reader);
    } catch (error) {
      throw asRecordingError(error, bytes);
    }
  }

  async *messages(
    topics: readonly string[],
    fromNs: bigint,
    onDamage?: (fault: RecordingError) => void,
  ): AsyncGenerator<RecordedMessage, void, void> {
    let startTime: bigint | null = fromNs;
    while (startTime !== null) {
      try {
        for await (const message of this.#reader.readMessages({ topics, startTime })) {
          const topic = this.#topicOfChannel.get(message.channelId);
          if (topic === undefined) continue;
          yield { topic, logNs: message.logTime, data: message.data, offset: this.#bytes.lastOffset };
        }
        return;
      } catch (error) {
        const fault = asRecordingError(error, this.#bytes);
        startTime = this.#timeAfter(fault.offset ?? 0, startTime);
        if (onDamage === undefined || startTime === null) throw fault;
        onDamage(fault);
      }
    }
  }

  /** The time after the chunk at this byte, if that is later than `fromNs`. */
  #timeAfter(offset: number, fromNs: bigint): bigint | null {
    for (const chunk of this.#reader.chunkIndexes) {
      const start = Number(chunk.chunkStartOffset);
      const end = start + Number(chunk.chunkLength + chunk.messageIndexLength);
      if (offset < start || offset >= end) continue;
      return chunk.messageEndTime >= fromNs ? chunk.messageEndTime + 1n : null;
    }
    return null;
  }

  close(): Promise<void> {
    return this.#bytes.close();
  }
}

/**
 * What the summary lacks for reading by it: everything in it but the footer is optional, and some recorders leave parts
 * out. `null` if nothing.
 */
function missingOf({
  chunkIndexes,
  statistics,
  channelsById,
  schemasById,
}: McapIndexedReader): string | null {
  if (chunkIndexes.length === 0) return statistics?.messageCount === 0n ? null : 'no index of chunks';
  for (const { messageIndexOffsets, messageEndTime } of chunkIndexes) {
    // A chunk without messages needs no index of them.
    if (messageIndexOffsets.size === 0 && messageEndTime > 0n) return 'no index of messages';
    for (const id of messageIndexOffsets.keys())
      if (!channelsById.has(id)) return `nothing about channel ${id}`;
  }
  for (const { schemaId } of channelsById.values())
    if (schemaId !== 0 && !schemasById.has(schemaId)) return `nothing about schema ${schemaId}`;
  return null;
}

/** An error of a library, with the position in the file. */
export function asRecordingError(error: unknown, { path, lastOffset }: FileBytes): RecordingError {
  if (error instanceof RecordingError && error.offset !== undefined) return error;
  const code = error instanceof RecordingError ? error.code : 'damaged';
  return new RecordingError(code, detailOf(error), { file: path, offset: lastOffset, cause: error });
}

/** The earliest and the latest time, 0 if there are none; bigint has no `Math.min`. */
export function timeRange(times: Iterable<bigint>): { first: bigint; last: bigint } {
  let [first, last]: [bigint | null, bigint | null] = [null, null];
  for (const time of times) {
    if (first === null || time < first) first = time;
    if (last === null || time > last) last = time;
  }
  return { first: first ?? 0n, last: last ?? 0n };
}
