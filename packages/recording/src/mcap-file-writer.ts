import { type FileHandle, open } from 'node:fs/promises';
import { crc32, constants as zlib, zstdCompressSync } from 'node:zlib';
import { McapRecordBuilder, type McapTypes } from '@mcap/core';
import { timeRange } from './mcap-indexed.ts';

/** A chunk is written once it has this many bytes. */
const CHUNK_BYTES = 1024 * 1024;
/** Larger messages are written at once without a copy, because their memory belongs to the caller. */
const COPY_BELOW_BYTES = 256 * 1024;
const MESSAGE_OPCODE = 5;
const CHUNK_OPCODE = 6;
/** Opcode and length, and a message's own fields. */
const MESSAGE_HEAD_BYTES = 1 + 8 + 2 + 4 + 8 + 8;

/** What follows everything else at the end of a file, besides the definitions and the index. */
const FOOTER_BYTES = 256;
/** Overhead of a chunk: header, index and entry in the chunk index, without what each message and channel adds. */
const CHUNK_EXTRA_BYTES = 256;
const MESSAGE_INDEX_BYTES = 16;
const CHANNEL_INDEX_BYTES = 15 + 10;

/** The file would become larger than allowed. It can still be closed, and is then complete. */
export class McapFileFull extends Error {
  override readonly name = 'McapFileFull';
}

export interface ChannelSpec {
  topic: string;
  messageEncoding: 'cdr' | 'json';
  /** `null` for JSON, which describes itself: some readers refuse a file because of a schema that they do not know. */
  schema: { name: string; encoding: 'ros2msg'; text: string } | null;
  /** Free-form metadata. */
  metadata?: Readonly<Record<string, string>>;
}

/**
 * Writes an MCAP file chunk by chunk. If the writer is killed, the file can be read up to the last chunk; the index
 * comes at the end. Large messages are not copied. Wait for each call before the next.
 */
export class McapFileWriter {
  messages = 0;
  bytes = 0;
  readonly #file: FileHandle;
  readonly #compression: 'none' | 'zstd';
  readonly #mostBytes: number;
  readonly #builder = new McapRecordBuilder();
  readonly #schemas: McapTypes.Schema[] = [];
  readonly #channels: McapTypes.Channel[] = [];
  readonly #counts = new Map<number, bigint>();
  /** The chunk index as it will be written: 100 bytes per chunk, and there may be hundreds of thousands. */
  readonly #chunkIndex = new McapRecordBuilder();
  #chunkCount = 0;
  #times: { first: bigint; last: bigint } | null = null;
  readonly #metadata: McapTypes.MetadataIndex[] = [];
  /** Of the chunk that is being filled. */
  #parts: Uint8Array[] = [];
  #chunkBytes = 0;
  #chunkMessages = 0;
  #index = new Map<number, [bigint, bigint][]>();
  #firstNs = 0n;
  #lastNs = 0n;
  /** Of schemas and channels, which are repeated at the end, and of metadata about the recording. */
  #definitionBytes = 0;

  private constructor(file: FileHandle, compression: 'none' | 'zstd', mostBytes: number) {
    this.#file = file;
    this.#compression = compression;
    this.#mostBytes = mostBytes;
  }

  /** @throws {Error} if the file already exists or cannot be created */
  static async create(
    path: string,
    compression: 'none' | 'zstd',
    library: string,
    mostBytes = Number.POSITIVE_INFINITY,
  ): Promise<McapFileWriter> {
    const writer = new McapFileWriter(await open(path, 'wx', 0o640), compression, mostBytes);
    writer.#builder.writeMagic();
    writer.#builder.writeHeader({ profile: 'ros2', library });
    await writer.#writeBuilder();
    return writer;
  }

  /** @returns the channel's number */
  addChannel({ topic, messageEncoding, schema, metadata = {} }: ChannelSpec): number {
    const id = this.#channels.length;
    const before = this.#builder.length;
    let schemaId = 0;
    if (schema !== null) {
      schemaId = this.#schemas.length + 1;
      const data = new TextEncoder().encode(schema.text);
      const record = { id: schemaId, name: schema.name, encoding: schema.encoding, data };
      this.#schemas.push(record);
      this.#builder.writeSchema(record);
    }
    const words = new Map(Object.entries(metadata));
    const channel = { id, schemaId, topic, messageEncoding, metadata: words };
    this.#channels.push(channel);
    this.#builder.writeChannel(channel);
    const definition = this.#builder.buffer.slice(before);
    this.#definitionBytes += definition.length + CHANNEL_INDEX_BYTES;
    this.#addPart(definition);
    this.#builder.reset();
    return id;
  }

  /**
   * @param data one message in parts, which must not be changed until the promise is resolved
   * @throws {McapFileFull} without having written any of it
   */
  async add(channelId: number, sequence: number, logNs: bigint, data: readonly Uint8Array[]): Promise<void> {
    const dataBytes = data.reduce((sum, part) => sum + part.length, 0);
    const more = MESSAGE_HEAD_BYTES + dataBytes + MESSAGE_INDEX_BYTES;
    // Pending data may be compressed, and so take less than it seems.
    if (this.#closedBytes() + more > this.#mostBytes) await this.flush();
    if (this.#closedBytes() + more > this.#mostBytes)
      throw new McapFileFull(`no room for ${dataBytes} bytes more within ${this.#mostBytes}`);
    const head = new DataView(new ArrayBuffer(MESSAGE_HEAD_BYTES));
    head.setUint8(0, MESSAGE_OPCODE);
    head.setBigUint64(1, BigInt(MESSAGE_HEAD_BYTES - 9 + dataBytes), true);
    head.setUint16(9, channelId, true);
    head.setUint32(11, sequence, true);
    head.setBigUint64(15, logNs, true);
    head.setBigUint64(23, logNs, true);
    const entries = this.#index.get(channelId) ?? [];
    this.#index.set(channelId, entries);
    if (this.#index.size === 1 && entries.length === 0) {
      this.#firstNs = logNs;
      this.#lastNs = logNs;
    }
    if (logNs < this.#firstNs) this.#firstNs = logNs;
    if (logNs > this.#lastNs) this.#lastNs = logNs;
    entries.push([logNs, BigInt(this.#chunkBytes)]);
    this.#addPart(new Uint8Array(head.buffer));
    const large = dataBytes >= COPY_BELOW_BYTES;
    for (const part of data) this.#addPart(large ? part : part.slice());
    this.#counts.set(channelId, (this.#counts.get(channelId) ?? 0n) + 1n);
    this.messages++;
    this.#chunkMessages++;
    if (large || this.#chunkBytes >= CHUNK_BYTES) await this.flush();
  }

  /** Writes the chunk that is being filled: from now on, it survives the end of this process. */
  async flush(): Promise<void> {
    if (this.#index.size === 0) return;
    const parts = this.#parts;
    const crc = parts.reduce((sum, part) => crc32(part, sum), 0);
    const packed = this.#compression === 'zstd' ? [packZstd(parts)] : parts;
    const compression = this.#compression === 'zstd' ? 'zstd' : '';
    const packedBytes = packed.reduce((sum, part) => sum + part.length, 0);
    const chunkStartOffset = BigInt(this.bytes);
    const head = chunkHead(
      { first: this.#firstNs, last: this.#lastNs, bytes: this.#chunkBytes, crc },
      compression,
      packedBytes,
    );
    const chunkLength = head.length + packedBytes;
    const messageIndexOffsets = new Map<number, bigint>();
    for (const [channelId, records] of this.#index) {
      messageIndexOffsets.set(channelId, chunkStartOffset + BigInt(chunkLength + this.#builder.length));
      this.#builder.writeMessageIndex({ channelId, records });
    }
    const times = { first: this.#firstNs, last: this.#lastNs };
    this.#times =
      this.#times === null
        ? times
        : timeRange([this.#times.first, this.#times.last, times.first, times.last]);
    this.#chunkCount++;
    this.#chunkIndex.writeChunkIndex({
      messageStartTime: this.#firstNs,
      messageEndTime: this.#lastNs,
      chunkStartOffset,
      chunkLength: BigInt(chunkLength),
      messageIndexOffsets,
      messageIndexLength: BigInt(this.#builder.length),
      compression,
      compressedSize: BigInt(packedBytes),
      uncompressedSize: BigInt(this.#chunkBytes),
    });
    await this.#write([head, ...packed, this.#builder.buffer]);
    this.#builder.reset();
    this.#parts = [];
    this.#chunkBytes = 0;
    this.#chunkMessages = 0;
    this.#index = new Map();
  }

  /** Adds metadata about the recording. */
  async addMetadata(name: string, values: Record<string, string>): Promise<void> {
    await this.flush();
    const offset = BigInt(this.bytes);
    const length = this.#builder.writeMetadata({ name, metadata: new Map(Object.entries(values)) });
    this.#metadata.push({ offset, length, name });
    this.#definitionBytes += name.length + 64;
    await this.#writeBuilder();
  }

  /** Makes everything that was flushed survive a crash of the machine, too. */
  sync(): Promise<void> {
    return this.#file.datasync();
  }

  /** Writes the index and the end of the file. */
  async close(): Promise<void> {
    await this.flush();
    const builder = this.#builder;
    builder.writeDataEnd({ dataSectionCrc: 0 });
    await this.#writeBuilder();
    const summaryStart = BigInt(this.bytes);
    for (const schema of this.#schemas) builder.writeSchema(schema);
    for (const channel of this.#channels) builder.writeChannel(channel);
    builder.writeStatistics({
      messageCount: BigInt(this.messages),
      schemaCount: this.#schemas.length,
      channelCount: this.#channels.length,
      attachmentCount: 0,
      metadataCount: this.#metadata.length,
      chunkCount: this.#chunkCount,
      messageStartTime: this.#times?.first ?? 0n,
      messageEndTime: this.#times?.last ?? 0n,
      channelMessageCounts: this.#counts,
    });
    await this.#writeBuilder();
    await this.#write([this.#chunkIndex.buffer]);
    for (const metadata of this.#metadata) builder.writeMetadataIndex(metadata);
    builder.writeFooter({ summaryStart, summaryOffsetStart: 0n, summaryCrc: 0 });
    builder.writeMagic();
    await this.#writeBuilder();
    await this.#file.sync();
    await this.#file.close();
  }

  /** Leaves the file as it is: whole up to its last chunk. */
  abandon(): void {
    void this.#file.close().catch(() => {});
  }

  /** The largest size that the file would have if it were closed now. */
  #closedBytes(): number {
    const chunk =
      this.#chunkBytes +
      CHUNK_EXTRA_BYTES +
      this.#chunkMessages * MESSAGE_INDEX_BYTES +
      this.#channels.length * 2 * CHANNEL_INDEX_BYTES;
    return this.bytes + chunk + this.#definitionBytes + this.#chunkIndex.length + FOOTER_BYTES;
  }

  #addPart(part: Uint8Array): void {
    this.#parts.push(part);
    this.#chunkBytes += part.length;
  }

  async #writeBuilder(): Promise<void> {
    await this.#write([this.#builder.buffer]);
    this.#builder.reset();
  }

  async #write(parts: readonly Uint8Array[]): Promise<void> {
    const total = parts.reduce((sum, part) => sum + part.length, 0);
    const { bytesWritten } = await this.#file.writev(parts as Uint8Array[]);
    if (bytesWritten !== total)
      throw new Error(`only ${bytesWritten} of ${total} bytes were written: disk full?`);
    this.bytes += total;
  }
}

/** Everything in a chunk before its records. */
function chunkHead(
  chunk: { first: bigint; last: bigint; bytes: number; crc: number },
  compression: string,
  packedBytes: number,
): Uint8Array {
  const name = new TextEncoder().encode(compression);
  const head = new Uint8Array(9 + 8 + 8 + 8 + 4 + 4 + name.length + 8);
  const view = new DataView(head.buffer);
  view.setUint8(0, CHUNK_OPCODE);
  view.setBigUint64(1, BigInt(head.length - 9 + packedBytes), true);
  view.setBigUint64(9, chunk.first, true);
  view.setBigUint64(17, chunk.last, true);
  view.setBigUint64(25, BigInt(chunk.bytes), true);
  view.setUint32(33, chunk.crc, true);
  view.setUint32(37, name.length, true);
  head.set(name, 41);
  view.setBigUint64(41 + name.length, BigInt(packedBytes), true);
  return head;
}

function packZstd(parts: readonly Uint8Array[]): Uint8Array {
  return zstdCompressSync(Buffer.concat(parts), { params: { [zlib.ZSTD_c_compressionLevel]: 1 } });
}
