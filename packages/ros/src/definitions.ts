/** Definitions of the messages in ROS’s own packages, by type. */
import type { MessageDefinition } from '@foxglove/message-definition';
import { ros1, ros2jazzy } from '@foxglove/rosmsg-msgs-common';
import { ros1TypeOf } from './topic-table.ts';

type Definitions = Readonly<Record<string, MessageDefinition | undefined>>;
/** The same messages under an older name. */
const OLDER_NAMES: Readonly<Record<string, string>> = { 'tf/tfMessage': 'tf2_msgs/TFMessage' };

/**
 * A type’s definition and those of all its parts, itself first.
 *
 * @param type in ROS 1 or ROS 2 notation
 * @returns `null` for types that are not part of ROS
 */
export function definitionsOf(version: 1 | 2, type: string): MessageDefinition[] | null {
  const known: Definitions = version === 1 ? ros1 : ros2jazzy;
  const name = ros1TypeOf(type);
  const found = new Map<string, MessageDefinition>();
  const wanted = [OLDER_NAMES[name] ?? name];
  for (let next = wanted.shift(); next !== undefined; next = wanted.shift()) {
    if (found.has(next)) continue;
    const definition = Object.hasOwn(known, next) ? known[next] : undefined;
    if (definition === undefined) return null;
    found.set(next, definition);
    for (const field of definition.definitions) if (field.isComplex === true) wanted.push(field.type);
  }
  return [...found.values()];
}
