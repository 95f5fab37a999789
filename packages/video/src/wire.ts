/**
 * Messages between this program and `farpoint-video`, on its standard input and output: u32 length of the payload, u8
 * type, payload; little-endian. `native/main.c` is the other side.
 */
import { HEADER_BYTES, WireError, WireMessageParser, writeMessage } from '@farpoint/media-process';
import { msOfNs } from '@farpoint/timing';

export {
  WireError as VideoWireError,
  type WireMessage,
  writeMessage,
  writeOpen,
} from '@farpoint/media-process';

/** No coded picture is near that; a longer message means that the output is not ours. */
export const MOST_MESSAGE_BYTES = 32 * 1024 * 1024;

export const TO_PROCESS = { open: 1, configure: 2, keyFrame: 3, frame: 4, coded: 5 } as const;
export const FROM_PROCESS = { encoded: 65, state: 66, error: 67 } as const;

/** What is before a picture's bytes, as it is written and read below. */
const ENCODED_HEAD_BYTES = 17;
const FRAME_HEAD_BYTES = 17;
const CODED_HEAD_BYTES = 10;
const LOST_FLAG = 1;
/** The whole message. */
const CONFIGURE_BYTES = 13;
const KEY_FLAG = 1;

/** Puts the messages of `farpoint-video` together. */
export class MessageParser extends WireMessageParser {
  constructor(mostBytes = MOST_MESSAGE_BYTES) {
    super(Object.values(FROM_PROCESS), mostBytes);
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

/** @throws {WireError} `bad-message` */
export function parseEncoded(payload: Uint8Array): EncodedFrame {
  if (payload.length <= ENCODED_HEAD_BYTES)
    throw new WireError('bad-message', `an encoded picture of ${payload.length} bytes`);
  const view = new DataView(payload.buffer, payload.byteOffset, payload.byteLength);
  const captureNs = view.getBigUint64(0, true);
  return {
    captureNs,
    captureMs: msOfNs(captureNs),
    key: (view.getUint8(8) & KEY_FLAG) !== 0,
    width: view.getUint16(9, true),
    height: view.getUint16(11, true),
    encodeMs: view.getUint32(13, true) / 1000,
    bytes: payload.subarray(ENCODED_HEAD_BYTES),
  };
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
