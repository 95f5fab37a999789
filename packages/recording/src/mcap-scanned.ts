import { McapRecordBuilder, McapStreamReader, type McapTypes } from '@mcap/core';
import { mcapDecompressors } from './decompress.ts';
import { detailOf, RecordingError } from './errors.ts';
import { type FileBytes, MAX_RECORD_BYTES } from './file-bytes.ts';
import { topicsOf } from './mcap-topics.ts';
import type { RecordedMessage, RecordedTopic, Recording } from './recording.ts';

/** What is read of the file at once. Chosen: about a chunk of usual recorders. */
const PIECE_BYTES = 1024 * 1024;
/** Positions at which reading may begin; if there are more chunks, every second one is dropped. */
const MOST_PLACES = 4096;

type Record = McapTypes.TypedMcapRecord;

/** A position at which reading may begin, and the time of the newest message before it. */
interface Place {
  offset: number;
  newestBeforeNs: bigint;
}

/**
 * An MCAP file without an index, or with half of one, as left by a recorder that was killed or that writes none: read
 * from front to back, up to its last complete chunk. Of the file, only one chunk is in memory.
 */
export class ScannedMcap implements Recording {
  readonly file: string;
  readonly topics: readonly RecordedTopic[];
  readonly startNs: bigint;
  readonly endNs: bigint;
  readonly warning: string | null;
  /** Where the readable part ends. */
  readonly wholeBytes: number;
  readonly #bytes: FileBytes;
  readonly #scan: Scan;
  readonly #topicOfChannel: ReadonlyMap<number, RecordedTopic>;

  private constructor(bytes: FileBytes, scan: Scan) {
    this.file = bytes.path;
    this.#bytes = bytes;
    this.#scan = scan;
    const { topics, byChannel } = topicsOf(
      scan.channels.values(),
      scan.schemas,
      (id) => scan.counts.get(id) ?? 0,
    );
    this.topics = topics;
    this.#topicOfChannel = byChannel;
    this.startNs = scan.startNs ?? 0n;
    this.endNs = scan.endNs;
    this.warning = scan.fault;
    this.wholeBytes = scan.wholeBytes;
  }

  /**
   * Reads the file once.
   *
   * @throws {RecordingError} if not even one message can be read
   */
  static async open(bytes: FileBytes): Promise<ScannedMcap> {
    const scan = new Scan();
    try {
      for await (const record of recordsOf(bytes, 0, null)) scan.add(record);
    } catch (error) {
      if (scan.startNs === null || !(error instanceof RecordingError)) throw error;
      scan.fault = `${error.message}; it is played up to there`;
    }
    return new ScannedMcap(bytes, scan);
  }

  async *messages(topics: readonly string[], fromNs: bigint): AsyncGenerator<RecordedMessage, void, void> {
    const place = this.#scan.placeBefore(fromNs);
    const known = place.offset === 0 ? null : this.#scan;
    try {
      for await (const { record, offset } of recordsOf(this.#bytes, place.offset, known)) {
        if (offset > this.wholeBytes) return;
        if (record.type !== 'Message' || record.logTime < fromNs) continue;
        const topic = this.#topicOfChannel.get(record.channelId);
        if (topic === undefined || !topics.includes(topic.name)) continue;
        yield { topic, logNs: record.logTime, data: record.data.slice(), offset };
      }
    } catch (error) {
      // Where the file ends has already been reported.
      if (this.warning === null || !(error instanceof RecordingError)) throw error;
    }
  }

  close(): Promise<void> {
    return this.#bytes.close();
  }
}

/** The result of reading the whole file once. */
class Scan {
  readonly schemas = new Map<number, McapTypes.Schema>();
  readonly channels = new Map<number, McapTypes.Channel>();
  readonly counts = new Map<number, number>();
  startNs: bigint | null = null;
  endNs = 0n;
  fault: string | null = null;
  wholeBytes = 0;
  #places: Place[] = [{ offset: 0, newestBeforeNs: 0n }];
  #stride = 1;
  #chunks = 0;

  add({ record, offset }: PlacedRecord): void {
    this.wholeBytes = offset;
    switch (record.type) {
      case 'Schema':
        this.schemas.set(record.id, { ...record, data: record.data.slice() });
        break;
      case 'Channel':
        this.channels.set(record.id, record);
        break;
      case 'Chunk':
        // Its messages follow it, at the same offset: reading may begin after the chunk before.
        if (this.#chunks++ % this.#stride !== 0) break;
        this.#places.push({ offset: offset - chunkBytes(record), newestBeforeNs: this.endNs });
        if (this.#places.length > MOST_PLACES) {
          this.#places = this.#places.filter((_, i) => i % 2 === 0);
          this.#stride *= 2;
        }
        break;
      case 'Message':
        this.counts.set(record.channelId, (this.counts.get(record.channelId) ?? 0) + 1);
        if (this.startNs === null || record.logTime < this.startNs) this.startNs = record.logTime;
        if (record.logTime > this.endNs) this.endNs = record.logTime;
        break;
    }
  }

  /** The last position before which every message is older. */
  placeBefore(ns: bigint): Place {
    let best = this.#places[0] as Place;
    for (const place of this.#places) {
      if (place.newestBeforeNs >= ns) break;
      best = place;
    }
    return best;
  }
}

interface PlacedRecord {
  record: Record;
  /** Byte after the record; for records inside a chunk, the byte after the chunk. */
  offset: number;
}

/**
 * @param known channels that messages after `from` may have, if `from` is not the beginning
 * @throws {RecordingError} `truncated`, `damaged` or `too-large`, with the byte at which the record begins
 */
async function* recordsOf(
  bytes: FileBytes,
  from: number,
  known: Pick<Scan, 'schemas' | 'channels'> | null,
): AsyncGenerator<PlacedRecord, void, void> {
  const reader = new McapStreamReader({
    includeChunks: true,
    decompressHandlers: mcapDecompressors,
    noMagicPrefix: known !== null,
  });
  if (known !== null) {
    reader.append(introduction(known));
    for (let record = reader.nextRecord(); record !== undefined; record = reader.nextRecord());
  }
  let offset = from;
  for (let fed = from; fed < bytes.size; ) {
    const piece = await bytes.read(fed, Math.min(PIECE_BYTES, bytes.size - fed));
    fed += piece.length;
    reader.append(piece);
    for (;;) {
      let record: Record | undefined;
      try {
        record = reader.nextRecord();
      } catch (error) {
        throw new RecordingError('damaged', detailOf(error), { file: bytes.path, offset, cause: error });
      }
      if (record === undefined) break;
      offset = fed - reader.bytesRemaining();
      yield { record, offset };
    }
    if (reader.done()) return;
    if (reader.bytesRemaining() > MAX_RECORD_BYTES) {
      throw new RecordingError('too-large', `a record of more than ${MAX_RECORD_BYTES} bytes`, {
        file: bytes.path,
        offset,
      });
    }
  }
  throw new RecordingError('truncated', 'the file ends without its index', { file: bytes.path, offset });
}

function introduction({ schemas, channels }: Pick<Scan, 'schemas' | 'channels'>): Uint8Array {
  const builder = new McapRecordBuilder();
  for (const schema of schemas.values()) builder.writeSchema(schema);
  for (const channel of channels.values()) builder.writeChannel(channel);
  return builder.buffer;
}

/** Opcode, length, and the chunk's own fields. */
function chunkBytes({ compression, records }: McapTypes.Chunk): number {
  return 9 + 8 + 8 + 8 + 4 + 4 + new TextEncoder().encode(compression).length + 8 + records.length;
}
