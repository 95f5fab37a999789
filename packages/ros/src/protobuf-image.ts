/**
 * Reads foxglove.CompressedImage, foxglove.CompressedVideo and foxglove.RawImage in Protobuf: the fields that are used, by their numbers, which
 * the schema fixes; others are skipped.
 *
 * Sources: Protocol Buffers' encoding, protobuf.dev/programming-guides/encoding; the schemas of
 * foxglove.CompressedImage, foxglove.CompressedVideo, foxglove.RawImage and google.protobuf.Timestamp.
 */
import { RosFault } from './fault.ts';

type Kind = 'text' | 'bytes' | 'fixed32' | 'int' | 'time';
type Value = string | number | Uint8Array | Message;
type Message = { [field: string]: Value };
type Fields = ReadonlyMap<number, readonly [name: string, kind: Kind]>;

/** Wire types (protobuf’s encoding, “Message Structure”). */
const VARINT = 0;
const EIGHT_BYTES = 1;
const LENGTH = 2;
const FOUR_BYTES = 5;

const WIRE_TYPES: Readonly<Record<Kind, number>> = {
  text: LENGTH,
  bytes: LENGTH,
  time: LENGTH,
  fixed32: FOUR_BYTES,
  int: VARINT,
};

const COMPRESSED_IMAGE: Fields = new Map([
  [1, ['timestamp', 'time']],
  [2, ['data', 'bytes']],
  [3, ['format', 'text']],
  [4, ['frame_id', 'text']],
]);
const COMPRESSED_VIDEO: Fields = new Map([
  [1, ['timestamp', 'time']],
  [2, ['frame_id', 'text']],
  [3, ['data', 'bytes']],
  [4, ['format', 'text']],
]);
const RAW_IMAGE: Fields = new Map([
  [1, ['timestamp', 'time']],
  [2, ['width', 'fixed32']],
  [3, ['height', 'fixed32']],
  [4, ['encoding', 'text']],
  [5, ['step', 'fixed32']],
  [6, ['data', 'bytes']],
  [7, ['frame_id', 'text']],
]);
const TIMESTAMP: Fields = new Map([
  [1, ['sec', 'int']],
  [2, ['nanosec', 'int']],
]);

const IMAGES: ReadonlyMap<string, Fields> = new Map([
  ['foxglove.CompressedImage', COMPRESSED_IMAGE],
  ['foxglove.CompressedVideo', COMPRESSED_VIDEO],
  ['foxglove.RawImage', RAW_IMAGE],
]);

/** @returns a reader for messages of that name, which throws {@link RosFault} `bad-message`; `null` for other names */
export function imageFromProtobuf(name: string): ((data: Uint8Array) => Message) | null {
  const fields = IMAGES.get(name);
  return fields === undefined ? null : (data) => read(data, fields);
}

/** Missing fields have their default: 0, or empty. */
function read(bytes: Uint8Array, fields: Fields): Message {
  const message: Message = {};
  for (const [name, kind] of fields.values()) message[name] = defaultOf(kind);
  const cursor = new Cursor(bytes);
  while (cursor.left > 0) {
    const key = cursor.varint();
    const wireType = Number(key & 7n);
    const field = fields.get(Number(key >> 3n));
    if (field === undefined || WIRE_TYPES[field[1]] !== wireType) {
      cursor.skip(wireType);
      continue;
    }
    const [name, kind] = field;
    message[name] = fieldOf(kind, cursor);
  }
  return message;
}

function fieldOf(kind: Kind, cursor: Cursor): Value {
  switch (kind) {
    case 'int':
      return Number(BigInt.asIntN(64, cursor.varint()));
    case 'fixed32':
      return cursor.fixed32();
    case 'bytes':
      return cursor.block();
    case 'text':
      return new TextDecoder().decode(cursor.block());
    case 'time':
      return read(cursor.block(), TIMESTAMP);
  }
}

function defaultOf(kind: Kind): Value {
  if (kind === 'text') return '';
  if (kind === 'bytes') return new Uint8Array(0);
  return kind === 'time' ? { sec: 0, nanosec: 0 } : 0;
}

/** The reader's position in a message; every step is checked. */
class Cursor {
  readonly #bytes: Uint8Array;
  readonly #view: DataView;
  #at = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get left(): number {
    return this.#bytes.length - this.#at;
  }

  varint(): bigint {
    let value = 0n;
    for (let shift = 0n; shift < 70n; shift += 7n) {
      const byte = this.#view.getUint8(this.#take(1));
      value |= BigInt(byte & 0x7f) << shift;
      if (byte < 0x80) return BigInt.asUintN(64, value);
    }
    throw new RosFault('bad-message', 'a number of more than ten bytes', { offset: this.#at });
  }

  fixed32(): number {
    return this.#view.getUint32(this.#take(4), true);
  }

  /** A view, not a copy. */
  block(): Uint8Array {
    const length = Number(this.varint());
    const at = this.#take(length);
    return this.#bytes.subarray(at, at + length);
  }

  skip(wireType: number): void {
    if (wireType === VARINT) this.varint();
    else if (wireType === EIGHT_BYTES) this.#take(8);
    else if (wireType === LENGTH) this.block();
    else if (wireType === FOUR_BYTES) this.#take(4);
    else throw new RosFault('bad-message', `a field of wire type ${wireType}`, { offset: this.#at });
  }

  /** @returns where the bytes begin */
  #take(length: number): number {
    if (length > this.left)
      throw new RosFault('bad-message', `it ends, ${length} bytes expected, ${this.left} are left`, {
        offset: this.#at,
      });
    const at = this.#at;
    this.#at += length;
    return at;
  }
}
