/**
 * Checks that a message is complete: walks through it by its definition before anything reads it. The library that
 * reads trusts lengths as far as the buffer around the message extends, and its errors do not say at which byte they
 * occurred.
 *
 * Source: DDSI-RTPS 2.5, 10.2 (header), DDS-XTypes 1.3, 7.4.1–7.4.3 (alignment of both versions of CDR).
 */
import type { MessageDefinition, MessageDefinitionField } from '@foxglove/message-definition';
import { RosFault } from './fault.ts';

/** The kind of CDR, and the number of padding bytes at the end, before each ROS 2 message. */
export const ENCAPSULATION_BYTES = 4;
/** The first kind of version 2 of CDR (DDS-XTypes 1.3, 7.6.3.1.2). */
const FIRST_OF_VERSION_2 = 6;
/** Final types in either version of CDR and either byte order, as ROS messages are written. */
const READABLE: ReadonlySet<number> = new Set([0, 1, 6, 7]);
/** ROS has no recursive messages, but a definition from outside may be recursive. */
const DEEPEST = 64;

/** Size of a value, which is also its alignment; values of 8 bytes are aligned to 4 in the second version. */
const SIZES: ReadonlyMap<string, number> = new Map([
  ...(['bool', 'byte', 'char', 'int8', 'uint8'] as const).map((type) => [type, 1] as const),
  ...(['int16', 'uint16'] as const).map((type) => [type, 2] as const),
  ...(['int32', 'uint32', 'float32'] as const).map((type) => [type, 4] as const),
  ...(['int64', 'uint64', 'float64'] as const).map((type) => [type, 8] as const),
]);

/** ROS 1 writes the same values without a header and without padding, little-endian. */
export type WireLayout = 'cdr' | 'ros1';

interface Field {
  name: string;
  /** Size of a primitive; 0 for strings and structures. */
  size: number;
  /** How many units of `size` one value has: two for a time. */
  parts: number;
  structure: Structure | null;
  /** Length of a fixed-size array; 1 for a single value; `null` if a length precedes the values. */
  count: number | null;
}

interface Structure {
  fields: Field[];
}

/**
 * @param definitions the type first, then all its parts
 * @returns a check that throws for incomplete messages, and otherwise returns the number of bytes that the message
 * takes
 * @throws {RosFault} `unsupported` for types with `wstring`, or with missing parts
 */
export function wireCheck(
  definitions: readonly MessageDefinition[],
  layout: WireLayout,
): (bytes: Uint8Array) => number {
  const structures = new Map<string, Structure>();
  const resolve = (name: string, fields: readonly MessageDefinitionField[]): Structure => {
    const known = structures.get(name);
    if (known !== undefined) return known;
    const structure: Structure = { fields: [] };
    structures.set(name, structure);
    for (const field of fields)
      if (field.isConstant !== true) structure.fields.push(toField(field, definitions, resolve));
    return structure;
  };
  const first = definitions.find(
    (each) => each.definitions.length === 0 || each.definitions.some(({ isConstant }) => isConstant !== true),
  );
  if (first === undefined) throw new RosFault('unsupported', 'a definition without a message');
  const root = resolve(first.name ?? '', first.definitions);
  return (bytes) => {
    const cursor = new Cursor(bytes, layout);
    walk(root, cursor, 0);
    return cursor.offset;
  };
}

function toField(
  { name, type, isArray, arrayLength, isComplex }: MessageDefinitionField,
  definitions: readonly MessageDefinition[],
  resolve: (name: string, fields: readonly MessageDefinitionField[]) => Structure,
): Field {
  const count = isArray === true ? (arrayLength ?? null) : 1;
  const field = { name, count, size: 0, parts: 1, structure: null };
  if (isComplex === true) {
    const of = definitions.find((each) => each.name === type);
    if (of === undefined) throw new RosFault('unsupported', `the type ${type} of ${name} is not known`);
    return { ...field, structure: resolve(type, of.definitions) };
  }
  if (type === 'string') return field;
  if (type === 'time' || type === 'duration') return { ...field, size: 4, parts: 2 };
  const size = SIZES.get(type);
  if (size === undefined) throw new RosFault('unsupported', `${name} is of the type ${type}`);
  return { ...field, size };
}

/** Position of the walk in a message. */
class Cursor {
  offset: number;
  readonly #begin: number;
  readonly #view: DataView;
  /** In CDR, an empty structure takes one byte, so that it is not empty. */
  readonly emptyBytes: number;
  readonly #littleEndian: boolean;
  readonly #mostAligned: number;

  constructor(bytes: Uint8Array, layout: WireLayout) {
    this.#begin = this.offset = layout === 'cdr' ? ENCAPSULATION_BYTES : 0;
    this.emptyBytes = layout === 'cdr' ? 1 : 0;
    if (layout === 'ros1') {
      this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
      this.#littleEndian = true;
      this.#mostAligned = 1;
      return;
    }
    if (bytes.length < ENCAPSULATION_BYTES)
      throw ended(bytes.length, 'its header', ENCAPSULATION_BYTES, bytes.length);
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const representation = this.#view.getUint16(0);
    // The library would take some of the others for another version of CDR than is checked here.
    if (!READABLE.has(representation)) {
      const kind = `0x${representation.toString(16).padStart(4, '0')}`;
      throw new RosFault('bad-message', `encapsulation ${kind} is none of CDR`, { offset: 0 });
    }
    this.#littleEndian = (representation & 1) === 1;
    this.#mostAligned = representation >= FIRST_OF_VERSION_2 ? 4 : 8;
  }

  get left(): number {
    return this.#view.byteLength - this.offset;
  }

  /** @throws {RosFault} if fewer bytes are left */
  skip(name: string, size: number, count: number): void {
    if (count === 0) return;
    const alignment = Math.min(size, this.#mostAligned);
    const begin = this.#begin + Math.ceil((this.offset - this.#begin) / alignment) * alignment;
    if (size * count > this.#view.byteLength - begin)
      throw ended(this.offset, name, size * count, Math.max(0, this.#view.byteLength - begin));
    this.offset = begin + size * count;
  }

  /** Reads the length of a list whose values take at least `least` bytes each. */
  length(name: string, least: number): number {
    this.skip(name, 4, 1);
    const at = this.offset - 4;
    const count = this.#view.getUint32(at, this.#littleEndian);
    if (count * least > this.left) throw ended(at, `${count} values of ${name}`, count * least, this.left);
    return count;
  }
}

function walk({ fields }: Structure, cursor: Cursor, depth: number): void {
  if (depth > DEEPEST) throw new RosFault('unsupported', `messages within messages, ${DEEPEST} deep`);
  if (fields.length === 0) cursor.skip('an empty message', 1, cursor.emptyBytes);
  for (const field of fields) {
    const { name, size, parts, structure } = field;
    // Every value takes at least one byte; a string starts with its own length.
    const least = structure === null && size === 0 ? 4 : Math.max(1, size * parts);
    const count = field.count ?? cursor.length(name, least);
    if (size > 0) {
      cursor.skip(name, size, count * parts);
      continue;
    }
    for (let i = 0; i < count; i++) {
      if (structure === null) cursor.skip(name, 1, cursor.length(name, 1));
      else walk(structure, cursor, depth + 1);
    }
  }
}

function ended(offset: number, what: string, needed: number, left: number): RosFault {
  const detail = `${what} needs ${needed} bytes, and ${left} are left`;
  return new RosFault('bad-message', `the message is cut short: ${detail}`, { offset });
}
