/** Definitions of messages that are not part of ROS, from the `.msg` files of their packages (ROS 2). */
import type { MessageDefinition } from '@foxglove/message-definition';
import { parse } from '@foxglove/rosmsg';
import { definitionsOf } from './definitions.ts';
import { RosFault } from './fault.ts';
import { ros1TypeOf } from './topic-table.ts';

/** Returns the text of `<package>/msg/<name>.msg`; `null` if there is none. */
export type ReadMessageFile = (packageName: string, name: string) => string | null;

/** More types than any message contains. */
const MOST_TYPES = 200;

/**
 * A type’s definition and those of all its parts, itself first.
 *
 * @throws {RosFault} `unsupported`: a file is missing or unreadable, with the file’s name
 */
export function definitionsFromFiles(type: string, read: ReadMessageFile): MessageDefinition[] {
  const found = new Map<string, MessageDefinition>();
  const wanted = [ros1TypeOf(type)];
  for (let next = wanted.shift(); next !== undefined; next = wanted.shift()) {
    if (found.has(next)) continue;
    if (found.size === MOST_TYPES) throw new RosFault('unsupported', `${type} is made of too many types`);
    const own = definitionsOf(2, next);
    for (const definition of own ?? [fromFile(next, read)]) {
      found.set(definition.name ?? next, definition);
      if (own !== null) continue;
      for (const field of definition.definitions) if (field.isComplex === true) wanted.push(field.type);
    }
  }
  return [...found.values()];
}

function fromFile(name: string, read: ReadMessageFile): MessageDefinition {
  const [packageName = '', typeName = ''] = name.split('/');
  const file = `${packageName}/msg/${typeName}.msg`;
  const text = read(packageName, typeName);
  if (text === null) throw new RosFault('unsupported', `${file} was not found`);
  let parsed: MessageDefinition[];
  try {
    parsed = parse(text, { ros2: true, skipTypeFixup: true });
  } catch (error) {
    throw new RosFault('unsupported', `${file} cannot be read: ${(error as Error).message}`, {
      cause: error,
    });
  }
  // Types of the same package are written without the package name.
  const definitions = (parsed[0]?.definitions ?? []).map((field) =>
    field.isComplex === true
      ? { ...field, type: ros1TypeOf(field.type.includes('/') ? field.type : `${packageName}/${field.type}`) }
      : field,
  );
  return { name, definitions };
}
