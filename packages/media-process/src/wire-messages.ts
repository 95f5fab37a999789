/**
 * Messages between this program and a media process, on its standard input and output: u32 length of the payload, u8
 * type, payload; little-endian. `native/wire.h` is the other side.
 */
import { WireError } from './wire-error.ts';

/** Length and type. */
export const HEADER_BYTES = 5;
/** Messages that every such program has. */
export const COMMON_TO_PROCESS = { open: 1, configure: 2 } as const;
export const COMMON_FROM_PROCESS = { state: 66, error: 67 } as const;

export interface WireMessage {
  readonly type: number;
  /** Belongs to the receiver: nothing is written there any more. */
  readonly payload: Uint8Array;
}

/** Puts messages together from chunks, however they are cut. A message within one chunk is not copied. */
export class WireMessageParser {
  readonly #types: readonly number[];
  readonly #mostBytes: number;
  readonly #header = new Uint8Array(HEADER_BYTES);
  #headerBytes = 0;
  /** Payload under way, and how much of it there is. */
  #payload: Uint8Array | null = null;
  #payloadBytes = 0;

  /**
   * @param types those that the process sends
   * @param mostBytes of a payload; a longer one means that the output is not ours
   */
  constructor(types: readonly number[], mostBytes: number) {
    this.#types = types;
    this.#mostBytes = mostBytes;
  }

  /** @throws {WireError} `too-large` or `unknown-type`; what follows such a message cannot be read */
  push(chunk: Uint8Array, onMessage: (message: WireMessage) => void): void {
    for (let at = 0; at < chunk.length; ) {
      if (this.#headerBytes < HEADER_BYTES) {
        at += this.#takeHeader(chunk.subarray(at));
        if (this.#headerBytes < HEADER_BYTES) return;
        if (this.#length() > 0) continue;
        this.#finish(new Uint8Array(0), onMessage);
        continue;
      }
      const length = this.#length();
      if (this.#payload === null && chunk.length - at >= length) {
        this.#finish(chunk.subarray(at, at + length), onMessage);
        at += length;
        continue;
      }
      this.#payload ??= new Uint8Array(length);
      const part = chunk.subarray(at, at + length - this.#payloadBytes);
      this.#payload.set(part, this.#payloadBytes);
      this.#payloadBytes += part.length;
      at += part.length;
      if (this.#payloadBytes === length) this.#finish(this.#payload, onMessage);
    }
  }

  #length(): number {
    return new DataView(this.#header.buffer).getUint32(0, true);
  }

  #takeHeader(from: Uint8Array): number {
    const part = from.subarray(0, HEADER_BYTES - this.#headerBytes);
    this.#header.set(part, this.#headerBytes);
    this.#headerBytes += part.length;
    if (this.#headerBytes === HEADER_BYTES) {
      const type = this.#header[4]!;
      if (!this.#types.includes(type))
        throw new WireError('unknown-type', `a message of the unknown type ${type}`);
      const length = this.#length();
      if (length > this.#mostBytes)
        throw new WireError('too-large', `a message of ${length} bytes; ${this.#mostBytes} are allowed`);
    }
    return part.length;
  }

  #finish(payload: Uint8Array, onMessage: (message: WireMessage) => void): void {
    const type = this.#header[4]!;
    this.#headerBytes = 0;
    this.#payload = null;
    this.#payloadBytes = 0;
    onMessage({ type, payload });
  }
}

/** A whole message. */
export function writeMessage(type: number, payload: Uint8Array): Uint8Array {
  const message = new Uint8Array(HEADER_BYTES + payload.length);
  const view = new DataView(message.buffer);
  view.setUint32(0, payload.length, true);
  view.setUint8(4, type);
  message.set(payload, HEADER_BYTES);
  return message;
}

/**
 * What the process is to do: texts by name, some of them repeated.
 *
 * @throws {WireError} `bad-message` if a text contains a zero byte
 */
export function writeOpen(fields: readonly (readonly [string, string])[]): Uint8Array {
  for (const [name, text] of fields)
    if (text.includes('\0')) throw new WireError('bad-message', `${name} contains a zero byte`);
  const text = fields.map(([name, value]) => `${name}=${value}\0`).join('');
  return writeMessage(COMMON_TO_PROCESS.open, new TextEncoder().encode(text));
}
