import { expect, test } from 'vitest';
import * as z from 'zod/mini';
import { ProtocolError } from './errors.ts';
import { decodeJson, encodeJson, encodeJsonBytes, type JsonCodec } from './json.ts';

const codec: JsonCodec<{ name: string; list: { n: number }[] }> = {
  what: 'test message',
  schema: z.strictObject({ name: z.string(), list: z.array(z.strictObject({ n: z.number() })) }),
  maxBytes: 64,
};
const message = { name: 'Örn', list: [{ n: 1 }] };

function errorOf(data: string | Uint8Array | ArrayBuffer): ProtocolError {
  try {
    decodeJson(codec, data);
  } catch (error) {
    if (error instanceof ProtocolError) return error;
    throw error;
  }
  throw new Error('decoded');
}

test('text, bytes and buffers give the same message', () => {
  const bytes = encodeJsonBytes(codec, message);
  expect(decodeJson(codec, encodeJson(codec, message))).toEqual(message);
  expect(decodeJson(codec, bytes)).toEqual(message);
  expect(decodeJson(codec, bytes.buffer as ArrayBuffer)).toEqual(message);
  const inside = new Uint8Array([0, ...bytes, 0]).subarray(1, -1);
  expect(decodeJson(codec, inside)).toEqual(message);
});

test('the error says what is wrong and where', () => {
  const error = errorOf('{"name":"a","list":[{"n":1},{"n":"2"}]}');
  expect(error).toMatchObject({
    name: 'ProtocolError',
    code: 'invalid',
    what: 'test message',
    path: 'list.1.n',
  });
  expect(error.message).toBe('test message: list.1.n: Invalid input: expected number, received string');
  expect(errorOf('[').message).toBe('test message: not valid JSON');
});

test('checks the size before it parses anything', () => {
  expect(errorOf('['.repeat(65)).code).toBe('too-large');
  expect(errorOf(new Uint8Array(65).fill(0xff)).code).toBe('too-large');
  expect(errorOf(new Uint8Array(64).fill(0xff)).code).toBe('not-utf8');
});

test('refuses deep nesting without crashing', () => {
  const deep: JsonCodec<unknown> = { ...codec, maxBytes: 1e6 };
  expect(() => decodeJson(deep, '['.repeat(500_000))).toThrow(ProtocolError);
  expect(() => decodeJson(deep, `${'['.repeat(400_000)}${']'.repeat(400_000)}`)).toThrow(ProtocolError);
});
