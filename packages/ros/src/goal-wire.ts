/**
 * The messages of an action server of ROS 1: a goal is published, may be cancelled, and its end is told by its result.
 * The goal’s fields are the action’s own; everything before them is the same for all. Pure.
 */
import type { MessageDefinition } from '@foxglove/message-definition';
import { parse } from '@foxglove/rosmsg';
import { definitionsOf } from './definitions.ts';
import { RosFault } from './fault.ts';
import { ros1TypeOf } from './topic-table.ts';

/** The states of a goal (actionlib_msgs/GoalStatus). */
const STATUS = [
  'pending',
  'active',
  'cancelled',
  'done',
  'failed',
  'refused',
  'active',
  'active',
  'cancelled',
  'lost',
] as const;
type GoalState = (typeof STATUS)[number];

/** What an action server says of a goal. */
export interface GoalStatus {
  /** Names the goal: chosen by whoever sent it. */
  id: string;
  state: GoalState;
  /** For people; may be empty. */
  text: string;
}

/** Whether the goal has ended. */
export function isLastStatus(state: GoalState): boolean {
  return state !== 'pending' && state !== 'active';
}

/** The types of an action’s messages, in ROS 2 notation. @param type such as `move_base_msgs/MoveBase` */
export function actionTypes(type: string): {
  goal: string;
  action: string;
  feedback: string;
  result: string;
} {
  const [packageName = '', name = ''] = ros1TypeOf(type).split('/');
  const of = (end: string) => `${packageName}/msg/${name}${end}`;
  return {
    goal: of('Goal'),
    action: of('ActionGoal'),
    feedback: of('ActionFeedback'),
    result: of('ActionResult'),
  };
}

/**
 * @param type such as `move_base_msgs/MoveBase`
 * @param text the goal’s fields, as in the .action file above its first line of dashes; of its types, ROS’s own are known
 * @returns the definitions of the goal, and of the message that carries it, with all their parts, each itself first
 * @throws {RosFault} `unsupported`: it cannot be read, or has other types
 */
export function goalDefinitions(
  type: string,
  text: string,
): { goal: MessageDefinition[]; action: MessageDefinition[] } {
  const types = actionTypes(type);
  const name = ros1TypeOf(types.goal);
  const goal = withParts({ name, definitions: fieldsOf(text) });
  const carried = `std_msgs/Header header\nactionlib_msgs/GoalID goal_id\n${name} goal`;
  return {
    goal,
    action: withParts({ name: ros1TypeOf(types.action), definitions: fieldsOf(carried) }, goal),
  };
}

/**
 * The same in ROS 2, of the goal alone: what carries it is the same for all actions. Constants are left out.
 *
 * @throws {RosFault} `unsupported`: it cannot be read, or has other types
 */
export function ros2GoalDefinitions(type: string, text: string): MessageDefinition[] {
  const fields = fieldsOf(text, 2).filter((field) => field.isConstant !== true);
  if (fields.some((field) => field.type === 'wstring'))
    throw new RosFault('unsupported', 'wstring is not supported');
  const definitions = fields.map((field) =>
    field.isComplex === true ? { ...field, type: ros1TypeOf(field.type) } : field,
  );
  return withParts({ name: `${ros1TypeOf(type)}_Goal`, definitions }, [], 2);
}

function fieldsOf(text: string, version: 1 | 2 = 1): MessageDefinition['definitions'] {
  let parsed: MessageDefinition[];
  try {
    parsed = parse(text, { skipTypeFixup: true, ros2: version === 2 });
  } catch (error) {
    throw new RosFault('unsupported', `cannot be read: ${(error as Error).message}`, { cause: error });
  }
  return (parsed[0]?.definitions ?? []).map((field) =>
    version === 1 && field.isComplex === true && field.type === 'Header'
      ? { ...field, type: 'std_msgs/Header' }
      : field,
  );
}

/** @throws {RosFault} */
function withParts(
  whole: MessageDefinition,
  known: readonly MessageDefinition[] = [],
  version: 1 | 2 = 1,
): MessageDefinition[] {
  const found = new Map([[whole.name ?? '', whole]]);
  for (const { type, isComplex } of whole.definitions) {
    if (isComplex !== true) continue;
    const parts = known.some(({ name }) => name === type) ? known : definitionsOf(version, type);
    if (parts === null) throw new RosFault('unsupported', `${type} is not one of ROS’s own types`);
    for (const part of parts) found.set(part.name ?? type, part);
  }
  return [...found.values()];
}

const utf8 = new TextEncoder();

/** Appends values as ROS 1 serialises them. */
class Bytes {
  readonly #parts: number[] = [];

  uint32(value: number): this {
    this.#parts.push(value & 0xff, (value >>> 8) & 0xff, (value >>> 16) & 0xff, value >>> 24);
    return this;
  }

  time(ms: number): this {
    return this.uint32(Math.floor(ms / 1000)).uint32(Math.floor((ms % 1000) * 1e6));
  }

  text(value: string): this {
    const bytes = utf8.encode(value);
    this.uint32(bytes.length);
    return this.bytes(bytes);
  }

  bytes(bytes: Uint8Array): this {
    for (const byte of bytes) this.#parts.push(byte);
    return this;
  }

  get whole(): Uint8Array {
    return Uint8Array.from(this.#parts);
  }
}

/** The message that sends a goal. @param id names it @param ms since 1970 @param goal serialised */
export function goalMessage(id: string, ms: number, goal: Uint8Array): Uint8Array {
  return new Bytes().uint32(0).time(ms).text('').time(ms).text(id).bytes(goal).whole;
}

/** The message that cancels a goal (actionlib_msgs/GoalID). */
export function cancelMessage(id: string): Uint8Array {
  return new Bytes().time(0).text(id).whole;
}

/** Longer texts are no status. Chosen: an identifier and a sentence; goal-wire.test.ts holds it. */
const MOST_TEXT = 4096;

/**
 * Reads the beginning of a result or feedback, which is the same for all actions: a header, then the goal’s status.
 *
 * @throws {RosFault} `bad-message`, with its place
 */
export function readGoalStatus(bytes: Uint8Array): GoalStatus {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 0;
  const skip = (length: number) => {
    if (length > bytes.length - at) throw new RosFault('bad-message', 'it is cut short', { offset: at });
    at += length;
    return at - length;
  };
  const text = () => {
    const length = view.getUint32(skip(4), true);
    if (length > MOST_TEXT)
      throw new RosFault('bad-message', `a text of ${length} bytes`, { offset: at - 4 });
    return new TextDecoder().decode(bytes.subarray(skip(length), at));
  };
  skip(12);
  text();
  skip(8);
  const id = text();
  const code = bytes[skip(1)] as number;
  const state = STATUS[code];
  if (state === undefined) throw new RosFault('bad-message', `the status ${code}`, { offset: at - 1 });
  return { id, state, text: text() };
}
