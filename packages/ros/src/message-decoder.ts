import type { MessageDefinition } from '@foxglove/message-definition';
import { parse } from '@foxglove/rosmsg';
import { MessageReader as Ros1Reader } from '@foxglove/rosmsg-serialization';
import { MessageReader as Ros2Reader } from '@foxglove/rosmsg2-serialization';
import { definitionsOf } from './definitions.ts';
import { RosFault } from './fault.ts';
import { imageFromProtobuf } from './protobuf-image.ts';
import { type WireLayout, wireCheck } from './wire-check.ts';

export interface MessageSchema {
  /** As in the recording, for example `foxglove.RawImage`. */
  name: string;
  /** How messages are encoded: `cdr`, `ros1`, `json` or `protobuf`. */
  messageEncoding: string;
  /** How the schema is encoded: `ros2msg` or `ros1msg`; other schemas are not read. */
  schemaEncoding: string;
  schema: Uint8Array;
}

/** Creates the decoder for the first message that needs it: most topics are never read. */
export function lazyDecoder(schema: MessageSchema): (data: Uint8Array) => unknown {
  let decode: ((data: Uint8Array) => unknown) | null = null;
  return (data) => {
    decode ??= makeDecoder(schema);
    return decode(data);
  };
}

/** @throws {RosFault} `unsupported`, or `bad-message` if the schema is unreadable */
function makeDecoder({ name, messageEncoding, schemaEncoding, schema }: MessageSchema) {
  if (messageEncoding === 'json') {
    return (data: Uint8Array) => JSON.parse(new TextDecoder().decode(data)) as unknown;
  }
  const image = messageEncoding === 'protobuf' ? imageFromProtobuf(name) : null;
  if (image !== null) return image;
  const text = new TextDecoder().decode(schema);
  if (text.trim() === '' && (messageEncoding === 'cdr' || messageEncoding === 'ros1'))
    return ofKnownType(messageEncoding, name);
  if (messageEncoding === 'cdr' && schemaEncoding === 'ros2msg') {
    return checkedReader('cdr', parsed(text, { ros2: true }));
  }
  if (messageEncoding === 'ros1' && schemaEncoding === 'ros1msg') {
    return checkedReader('ros1', parsed(text));
  }
  throw new RosFault(
    'unsupported',
    `${name || 'messages'} in ${messageEncoding} with a ${schemaEncoding || 'missing'} schema`,
  );
}

/** For recordings that leave out the definitions. @throws {RosFault} `unsupported` for types that are not part of ROS */
function ofKnownType(layout: WireLayout, name: string): (bytes: Uint8Array) => unknown {
  const definitions = definitionsOf(layout === 'ros1' ? 1 : 2, name);
  if (definitions !== null) return checkedReader(layout, definitions);
  const what = name === '' ? 'its messages have no type' : `there is no definition of ${name} with them`;
  throw new RosFault('unsupported', `the schema is empty: ${what}`);
}

/**
 * Decodes the messages of a live topic.
 *
 * @param definition for types that are not part of ROS: as stated by the publisher, or with all the parts
 * @throws {RosFault} `unsupported` if the definition is unknown, `bad-message` if it is unreadable
 */
export function decoderOf(
  version: 1 | 2,
  type: string,
  definition: string | MessageDefinition[] | null,
): (bytes: Uint8Array) => unknown {
  const told = typeof definition === 'string' ? parsed(definition) : definition;
  const definitions = definitionsOf(version, type) ?? told;
  if (definitions === null) {
    throw new RosFault('unsupported', `the message type ${type} is unknown`);
  }
  return checkedReader(version === 1 ? 'ros1' : 'cdr', definitions);
}

/** @throws {RosFault} `bad-message` for a definition that nobody can read */
function parsed(definition: string, options: { ros2?: boolean } = {}): MessageDefinition[] {
  try {
    return parse(definition, options);
  } catch (cause) {
    const [what] = cause instanceof Error ? cause.message.split('\n') : [];
    throw new RosFault('bad-message', `the message definition is unreadable: ${what}`, { cause });
  }
}

/** Refuses incomplete messages. */
function checkedReader(layout: WireLayout, definitions: MessageDefinition[]): (bytes: Uint8Array) => unknown {
  const check = wireCheck(definitions, layout);
  const reader = layout === 'ros1' ? new Ros1Reader(definitions) : new Ros2Reader(definitions);
  return (bytes) => {
    check(bytes);
    return reader.readMessage(bytes);
  };
}
