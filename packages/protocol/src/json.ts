import { en } from 'zod/locales';
import * as z from 'zod/mini';
import { ProtocolError } from './errors.ts';

const utf8 = new TextDecoder('utf-8', { fatal: true });
const utf8Encoder = new TextEncoder();
/** The small build of the schema library contains no error texts. */
const { localeError } = en();

/** Bytes or text as delivered by a socket or a data channel. */
export type MessageData = string | ArrayBuffer | Uint8Array;

export interface JsonCodec<T> {
  /** What the message is, for error texts. */
  readonly what: string;
  readonly schema: z.core.$ZodType<T>;
  /** Longest accepted message in bytes (UTF-16 units for text, whose UTF-8 form has at most three bytes per unit). */
  readonly maxBytes: number;
}

/**
 * Decodes one JSON message.
 *
 * @throws {ProtocolError} for anything that is not exactly such a message
 */
export function decodeJson<T>(codec: JsonCodec<T>, data: MessageData): T {
  const size = typeof data === 'string' ? data.length : data.byteLength;
  if (size > codec.maxBytes) {
    throw new ProtocolError('too-large', codec.what, '', `${size} bytes, at most ${codec.maxBytes} allowed`);
  }
  const parsed = z.safeParse(codec.schema, parseJson(codec.what, toText(codec.what, data)), {
    error: localeError,
  });
  if (parsed.success) return parsed.data;
  const issue = parsed.error.issues[0];
  throw new ProtocolError(
    'invalid',
    codec.what,
    issue === undefined ? '' : issue.path.map(String).join('.'),
    issue === undefined ? 'not valid' : issue.message,
  );
}

/** Encodes a message as JSON text. The type guarantees the content; nothing is checked again. */
export function encodeJson<T>(_codec: JsonCodec<T>, message: T): string {
  return JSON.stringify(message);
}

/** Encodes a message as UTF-8 JSON bytes, as the reference system sends its control messages. */
export function encodeJsonBytes<T>(codec: JsonCodec<T>, message: T): Uint8Array {
  return utf8Encoder.encode(encodeJson(codec, message));
}

function toText(what: string, data: MessageData): string {
  if (typeof data === 'string') return data;
  try {
    return utf8.decode(data);
  } catch {
    throw new ProtocolError('not-utf8', what, '', 'not valid UTF-8');
  }
}

function parseJson(what: string, text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    throw new ProtocolError('not-json', what, '', 'not valid JSON');
  }
}
