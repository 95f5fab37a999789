/**
 * Messages between this program and `farpoint-video`, on its standard input and output: u32 length of the payload, u8
 * type, payload; little-endian. `native/wire.h` and `native/main.c` are the other side.
 */

export const HEADER_BYTES = 5;
/** No coded picture is near that; a longer message means that the output is not ours. */
export const MOST_MESSAGE_BYTES = 32 * 1024 * 1024;

export const TO_PROCESS = { open: 1, configure: 2, keyFrame: 3, frame: 4, coded: 5 } as const;
export const FROM_PROCESS = { encoded: 65, state: 66, error: 67 } as const;

const ENCODED_HEAD_BYTES = 17;
const FRAME_HEAD_BYTES = 17;
const CODED_HEAD_BYTES = 10;
const LOST_FLAG = 1;
const CONFIGURE_BYTES = 13;
const KEY_FLAG = 1;
const NS_PER_MS = 1_000_000n;

export type VideoWireErrorCode =
  | 'too-large' // a message that announces more bytes than there is room for
  | 'unknown-type' // a type that is not in the list
  | 'bad-message'; // a payload that is too short or not valid

/** What is wrong with the bytes that came from the process. */
export class VideoWireError extends Error {
  override readonly name = 'VideoWireError';
  readonly code: VideoWireErrorCode;

  constructor(code: VideoWireErrorCode, what: string, options?: ErrorOptions) {
    super(what, options);
    this.code = code;
  }
}

export interface WireMessage {
  readonly type: number;
  /** Belongs to the receiver: nothing is written there any more. */
  readonly payload: Uint8Array;
}

/** Puts messages together from chunks, however they are cut. A message within one chunk is not copied. */
export class MessageParser {
  readonly #mostBytes: number;
  readonly #header = new Uint8Array(HEADER_BYTES);
  #headerBytes = 0;
  /** Payload under way, and how much of it there is. */
  #payload: Uint8Array | null = null;
  #payloadBytes = 0;

  constructor(mostBytes = MOST_MESSAGE_BYTES) {
    this.#mostBytes = mostBytes;
  }

  /** @throws {VideoWireError} `too-large` or `unknown-type`; what follows such a message cannot be read */
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
      if (!Object.values<number>(FROM_PROCESS).includes(type))
        throw new VideoWireError('unknown-type', `a message of the unknown type ${type}`);
      const length = this.#length();
      if (length > this.#mostBytes)
        throw new VideoWireError('too-large', `a message of ${length} bytes; ${this.#mostBytes} are allowed`);
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

export interface EncodedFrame {
  /** When the picture was captured: CLOCK_MONOTONIC, the clock of `process.hrtime`. */
  readonly captureNs: bigint;
  readonly captureMs: number;
  /** Whether it can be decoded without any other. */
  readonly key: boolean;
  readonly width: number;
  readonly height: number;
  /** How long it was in the encoder. */
  readonly encodeMs: number;
  /** H.264: an access unit as in Annex B, with its parameter sets if it is a key frame. VP8: a frame. */
  readonly bytes: Uint8Array;
}

/** @throws {VideoWireError} `bad-message` */
export function parseEncoded(payload: Uint8Array): EncodedFrame {
  if (payload.length <= ENCODED_HEAD_BYTES)
    throw new VideoWireError('bad-message', `an encoded picture of ${payload.length} bytes`);
  const view = new DataView(payload.buffer, payload.byteOffset, payload.byteLength);
  const captureNs = view.getBigUint64(0, true);
  return {
    captureNs,
    captureMs: Number(captureNs / NS_PER_MS) + Number(captureNs % NS_PER_MS) / 1e6,
    key: (view.getUint8(8) & KEY_FLAG) !== 0,
    width: view.getUint16(9, true),
    height: view.getUint16(11, true),
    encodeMs: view.getUint32(13, true) / 1000,
    bytes: payload.subarray(ENCODED_HEAD_BYTES),
  };
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

/** What the process is to encode: texts by name, some of them repeated. None may contain a zero byte. */
export function writeOpen(fields: readonly (readonly [string, string])[]): Uint8Array {
  for (const [name, text] of fields)
    if (text.includes('\0')) throw new VideoWireError('bad-message', `${name} contains a zero byte`);
  const text = fields.map(([name, value]) => `${name}=${value}\0`).join('');
  return writeMessage(TO_PROCESS.open, new TextEncoder().encode(text));
}

/** Clocks whose time can be drawn into the picture. */
export const BARCODE_CLOCKS = ['monotonic', 'unix'] as const;
export type BarcodeClock = (typeof BARCODE_CLOCKS)[number];

/** Absent numbers are no wish. */
export interface WireSettings {
  readonly bitsPerS: number;
  readonly framesPerS?: number | undefined;
  readonly width?: number | undefined;
  readonly height?: number | undefined;
  readonly barcode?: BarcodeClock | undefined;
}

export function writeConfigure(settings: WireSettings): Uint8Array {
  const payload = new Uint8Array(CONFIGURE_BYTES);
  const view = new DataView(payload.buffer);
  view.setUint32(0, Math.round(settings.bitsPerS), true);
  view.setUint32(4, Math.round((settings.framesPerS ?? 0) * 1000), true);
  view.setUint16(8, settings.width ?? 0, true);
  view.setUint16(10, settings.height ?? 0, true);
  view.setUint8(12, settings.barcode === undefined ? 0 : BARCODE_CLOCKS.indexOf(settings.barcode) + 1);
  return writeMessage(TO_PROCESS.configure, payload);
}

export function writeKeyFrame(): Uint8Array {
  return writeMessage(TO_PROCESS.keyFrame, new Uint8Array(0));
}

/** Formats of raw pictures, and their codes. */
export const RAW_FORMATS = {
  i420: 1,
  nv12: 2,
  yuy2: 3,
  uyvy: 4,
  rgb: 5,
  bgr: 6,
  rgba: 7,
  bgra: 8,
  gray: 9,
} as const;
export type RawFormat = keyof typeof RAW_FORMATS;

export interface RawFrame {
  /** When the picture was captured: CLOCK_MONOTONIC, the clock of `process.hrtime`. */
  readonly captureNs: bigint;
  readonly format: RawFormat;
  readonly width: number;
  readonly height: number;
  /** Bytes from one row to the next; for I420, a chroma row has half of that, rounded up. */
  readonly stride: number;
  /** The planes, one after the other. */
  readonly bytes: Uint8Array;
}

/** Bytes that a raw picture of this shape has. */
export function rawFrameBytes({
  format,
  height,
  stride,
}: Omit<RawFrame, 'bytes' | 'captureNs' | 'width'>): number {
  const chromaRows = Math.ceil(height / 2);
  if (format === 'i420') return stride * height + 2 * Math.ceil(stride / 2) * chromaRows;
  if (format === 'nv12') return stride * height + stride * chromaRows;
  return stride * height;
}

/** What precedes a raw picture's bytes. */
export function writeFrameHead({ captureNs, format, width, height, stride, bytes }: RawFrame): Uint8Array {
  const head = new Uint8Array(HEADER_BYTES + FRAME_HEAD_BYTES);
  const view = new DataView(head.buffer);
  view.setUint32(0, FRAME_HEAD_BYTES + bytes.length, true);
  view.setUint8(4, TO_PROCESS.frame);
  view.setBigUint64(5, captureNs, true);
  view.setUint8(13, RAW_FORMATS[format]);
  view.setUint16(14, width, true);
  view.setUint16(16, height, true);
  view.setUint32(18, stride, true);
  return head;
}

/** Codings of pictures that the process decodes, and their codes. */
export const CODINGS = { jpeg: 1, png: 2, h264: 3, vp8: 4 } as const;
export type Coding = keyof typeof CODINGS;
/** A picture of these is of use only if those before it were decoded. */
export const INTER_CODINGS: ReadonlySet<Coding> = new Set(['h264', 'vp8']);

/** The program refuses more. */
export const MOST_CODED_BYTES = 32 * 1024 * 1024;

export interface CodedPicture {
  /** When the picture was captured: CLOCK_MONOTONIC, the clock of `process.hrtime`. */
  readonly captureNs: bigint;
  readonly coding: Coding;
  /** A file of JPEG or PNG; an access unit of H.264 as in Annex B, with its parameter sets if it is a key frame; a frame of VP8. */
  readonly bytes: Uint8Array;
}

/**
 * What precedes a coded picture's bytes.
 *
 * @param lost whether pictures before this one are missing, so that a decoder has to wait for a key frame
 */
export function writeCodedHead({ captureNs, coding, bytes }: CodedPicture, lost: boolean): Uint8Array {
  const head = new Uint8Array(HEADER_BYTES + CODED_HEAD_BYTES);
  const view = new DataView(head.buffer);
  view.setUint32(0, CODED_HEAD_BYTES + bytes.length, true);
  view.setUint8(4, TO_PROCESS.coded);
  view.setBigUint64(5, captureNs, true);
  view.setUint8(13, CODINGS[coding]);
  view.setUint8(14, lost ? LOST_FLAG : 0);
  return head;
}
