/** A message that a configuration gives once and for all: checked against its definition, then encoded. */
import type { MessageDefinition, MessageDefinitionField } from '@foxglove/message-definition';
import { MessageWriter as Ros1Writer } from '@foxglove/rosmsg-serialization';
import { MessageWriter as Ros2Writer } from '@foxglove/rosmsg2-serialization';
import { definitionsOf } from './definitions.ts';
import { RosFault } from './fault.ts';

const INTEGERS: Readonly<Record<string, readonly [least: number, most: number]>> = {
  int8: [-(2 ** 7), 2 ** 7 - 1],
  uint8: [0, 2 ** 8 - 1],
  int16: [-(2 ** 15), 2 ** 15 - 1],
  uint16: [0, 2 ** 16 - 1],
  int32: [-(2 ** 31), 2 ** 31 - 1],
  uint32: [0, 2 ** 32 - 1],
};
const TIMES = new Set(['time', 'duration']);
const ASCII = /^[ -~]*$/;
const LONG = new Set(['int64', 'uint64']);
const LARGEST_FLOAT32 = (2 - 2 ** -23) * 2 ** 127;
/** More is no command's value. */
const MOST_ELEMENTS = 1024;
const MOST_TEXT = 4096;

/**
 * @param type in ROS 2 notation
 * @param value fields that it leaves out are zero, false or empty
 * @param definitions of the type and its parts, itself first; default: those of ROS’s own
 * @throws {RosFault} `unsupported` for a type without one, `bad-message` for a value that is none of the type, with its place
 */
export function fixedMessage(
  version: 1 | 2,
  type: string,
  value: unknown,
  definitions: MessageDefinition[] | null = definitionsOf(version, type),
): Uint8Array {
  const [whole] = definitions ?? [];
  if (definitions === null || whole === undefined)
    throw new RosFault('unsupported', `${type} is not one of ROS’s own types`);
  const parts = new Map(definitions.map((each) => [each.name ?? '', each]));
  const message = checked(whole, value, '', parts);
  const writer = version === 1 ? new Ros1Writer(definitions) : new Ros2Writer(definitions);
  return writer.writeMessage(message);
}

type Parts = ReadonlyMap<string, MessageDefinition>;

function checked(
  { definitions }: MessageDefinition,
  value: unknown,
  place: string,
  parts: Parts,
): Record<string, unknown> {
  if (typeof value !== 'object' || value === null || Array.isArray(value))
    throw bad(place, 'must be a mapping of fields');
  const fields = definitions.filter((field) => field.isConstant !== true);
  const given = new Map(Object.entries(value));
  for (const name of given.keys()) {
    if (!fields.some((field) => field.name === name)) throw bad(placeOf(place, name), 'is no field of it');
  }
  // The writers leave nothing out.
  return Object.fromEntries(
    fields.map((field) => {
      const inner = given.get(field.name);
      const at = placeOf(place, field.name);
      return [field.name, inner === undefined ? zeroOf(field, parts) : checkedField(field, inner, at, parts)];
    }),
  );
}

function zeroOf(field: MessageDefinitionField, parts: Parts): unknown {
  const { type, isComplex, isArray, arrayLength = 0 } = field;
  if (isArray === true)
    return Array.from({ length: arrayLength }, () => zeroOf({ ...field, isArray: false }, parts));
  if (isComplex === true) return checkedOne(field, {}, '', parts);
  if (type === 'bool') return false;
  if (type === 'string' || type === 'wstring') return '';
  // Each writer uses the field names of its own version.
  if (TIMES.has(type)) return { sec: 0, nsec: 0, nanosec: 0 };
  return LONG.has(type) ? 0n : 0;
}

function checkedField(field: MessageDefinitionField, value: unknown, place: string, parts: Parts): unknown {
  if (field.isArray !== true) return checkedOne(field, value, place, parts);
  if (!Array.isArray(value)) throw bad(place, 'must be a list');
  const { arrayLength, arrayUpperBound = MOST_ELEMENTS } = field;
  if (arrayLength !== undefined && value.length !== arrayLength)
    throw bad(place, `must have ${arrayLength} elements`);
  if (value.length > arrayUpperBound) throw bad(place, `must have at most ${arrayUpperBound} elements`);
  return value.map((each: unknown, index) => checkedOne(field, each, `${place}.${index}`, parts));
}

function checkedOne(field: MessageDefinitionField, value: unknown, place: string, parts: Parts): unknown {
  const { type, isComplex, upperBound = MOST_TEXT } = field;
  if (isComplex === true) {
    const part = parts.get(type);
    if (part === undefined) throw bad(place, `has an unknown type, ${type}`);
    return checked(part, value, place, parts);
  }
  if (type === 'bool') {
    if (typeof value !== 'boolean') throw bad(place, 'must be true or false');
    return value;
  }
  if (type === 'string' || type === 'wstring') {
    // The library’s writers know no others.
    if (typeof value !== 'string' || value.length > upperBound || !ASCII.test(value))
      throw bad(place, `must be text of at most ${upperBound} printable ASCII characters`);
    return value;
  }
  if (TIMES.has(type)) throw bad(place, 'is a time, which cannot be given');
  if (typeof value !== 'number' || !Number.isFinite(value)) throw bad(place, 'must be a number');
  return checkedNumber(type, value, place);
}

function checkedNumber(type: string, value: number, place: string): number | bigint {
  const [least, most] = INTEGERS[type] ?? [];
  if (least !== undefined && most !== undefined) {
    if (Number.isInteger(value) && value >= least && value <= most) return value;
    throw bad(place, `must be a whole number from ${least} to ${most}`);
  }
  if (LONG.has(type)) {
    if (Number.isSafeInteger(value) && (value >= 0 || type === 'int64')) return BigInt(value);
    throw bad(place, `must be a whole number that ${type} has`);
  }
  if (type === 'float32' && Math.abs(value) > LARGEST_FLOAT32) throw bad(place, 'is too large for float32');
  return value;
}

function placeOf(place: string, name: string): string {
  return place === '' ? name : `${place}.${name}`;
}

function bad(place: string, what: string): RosFault {
  return new RosFault('bad-message', place === '' ? what : `${place} ${what}`);
}
