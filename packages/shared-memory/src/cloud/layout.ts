/**
 * Farpoint's own layout, specified byte by byte in docs/shared-memory.md: a header of one page, then slots that are
 * filled in turn. Bytes in, values out; no I/O. Little-endian.
 */
import { join } from 'node:path';
import { type Pose, sequence32Of } from '@farpoint/protocol';
import { SharedMemoryError, type SharedMemoryErrorCode } from '../errors.ts';

export const CLOUD_FILE = 'farpoint_cloud';
export const MAGIC = 'FARPOINT';
export const VERSION = 1;
/** A page; two cache lines; and what docs/shared-memory.md allows a frame. */
export const HEADER_BYTES = 4096;
export const SLOT_HEADER_BYTES = 128;
export const MAX_POINTS = 4_194_304;
/** Number of the newest complete frame: the word that readers wait for. */
export const PUBLISHED_OFFSET = 64;

export const CLOUD_FORMATS = ['points', 'depth16', 'depth32'] as const;
/**
 * - `points`: x, y, z as float32 metres in the optical frame, then R, G, B, A.
 * - `depth16`: depth as u16 in units of `depthUnit`, then the colours as R, G, B, A.
 * - `depth32`: depth as float32 metres, then the colours.
 */
export type CloudFormat = (typeof CLOUD_FORMATS)[number];

const SLOT_COUNTS: readonly number[] = [4, 8, 16];

export interface CloudHeader {
  format: CloudFormat;
  /** 4, 8 or 16. */
  slots: number;
  slotBytes: number;
  /** Maximum number of points in a frame. */
  maxPoints: number;
  /** The producer's intended frame rate, frames per second; 0 if not stated. */
  framesPerSecond: number;
  /** The producer's process id, for people. */
  pid: number;
}

/** Pinhole model; pixel centres are at integer coordinates. */
export interface Lens {
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}

export interface FrameHeader {
  /** CLOCK_MONOTONIC, ms; `null` if the producer does not know it. */
  capturedAtMs: number | null;
  width: number;
  /** 1 if the points are not on a grid. */
  height: number;
  /** Pose of the camera's optical frame in the world. */
  pose: Pose | null;
  /** Always present for depth formats. */
  lens: Lens | null;
  /** Every point was made green. */
  latencyTest: boolean;
  /** Metres per unit of `depth16`; else 0. */
  depthUnit: number;
}

const HAS_POSE = 1;
const HAS_LENS = 2;
const IS_LATENCY_TEST = 4;

export function cloudFile(folder = '/dev/shm'): string {
  return join(folder, CLOUD_FILE);
}

export function slotOffset({ slots, slotBytes }: CloudHeader, frame: number): number {
  return HEADER_BYTES + (frame % slots) * slotBytes;
}

export function fileBytes({ slots, slotBytes }: CloudHeader): number {
  return HEADER_BYTES + slots * slotBytes;
}

/** Offset of a depth frame's colours within its payload. */
export function colourOffset(format: CloudFormat, points: number): number {
  return align64(points * (format === 'depth16' ? 2 : 4));
}

export function payloadBytes(format: CloudFormat, points: number): number {
  return format === 'points' ? points * 16 : colourOffset(format, points) + points * 4;
}

/** A header for frames of up to `maxPoints`. @throws {SharedMemoryError} `bad-header` */
export function makeHeader(
  wanted: Pick<CloudHeader, 'format' | 'maxPoints'> & Partial<CloudHeader>,
): CloudHeader {
  const { format, maxPoints, slots = 4, framesPerSecond = 0, pid = 0 } = wanted;
  const slotBytes = align64(SLOT_HEADER_BYTES + payloadBytes(format, maxPoints));
  const header = { format, maxPoints, slots, framesPerSecond, pid, slotBytes };
  const bytes = new Uint8Array(HEADER_BYTES);
  writeHeader(bytes, header);
  return parseHeader(bytes, fileBytes(header), CLOUD_FILE);
}

export function writeHeader(bytes: Uint8Array, header: CloudHeader): void {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let i = 0; i < MAGIC.length; i++) view.setUint8(i, MAGIC.charCodeAt(i));
  view.setUint32(8, VERSION, true);
  view.setUint32(12, HEADER_BYTES, true);
  view.setUint32(16, CLOUD_FORMATS.indexOf(header.format) + 1, true);
  view.setUint32(20, header.slots, true);
  view.setUint32(24, header.slotBytes, true);
  view.setUint32(28, header.maxPoints, true);
  view.setFloat32(32, header.framesPerSecond, true);
  view.setUint32(36, header.pid, true);
}

/**
 * @param bytes the first page
 * @param size of the whole file
 * @param file for errors
 * @throws {SharedMemoryError} `truncated`, `bad-magic`, `bad-version`, `bad-header`
 */
export function parseHeader(bytes: Uint8Array, size: number, file: string): CloudHeader {
  const fault = (code: SharedMemoryErrorCode, offset: number, detail: string) =>
    new SharedMemoryError(code, file, offset, detail);
  if (bytes.length < HEADER_BYTES || size < HEADER_BYTES)
    throw fault('truncated', Math.min(bytes.length, size), `the header has ${HEADER_BYTES} bytes`);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let i = 0; i < MAGIC.length; i++) {
    if (view.getUint8(i) !== MAGIC.charCodeAt(i))
      throw fault('bad-magic', i, `it does not begin with ${MAGIC}`);
  }
  const word = (offset: number) => view.getUint32(offset, true);
  if (word(8) !== VERSION) throw fault('bad-version', 8, `version ${word(8)}, ${VERSION} is known`);
  if (word(12) !== HEADER_BYTES) throw fault('bad-header', 12, `a header of ${word(12)} bytes`);
  const format = CLOUD_FORMATS[word(16) - 1];
  if (format === undefined) throw fault('bad-header', 16, `format ${word(16)} is unknown`);
  const slots = word(20);
  if (!SLOT_COUNTS.includes(slots)) throw fault('bad-header', 20, `${slots} slots, not 4, 8 or 16`);
  const [slotBytes, maxPoints] = [word(24), word(28)];
  if (maxPoints < 1 || maxPoints > MAX_POINTS) throw fault('bad-header', 28, `${maxPoints} points a frame`);
  if (slotBytes % 64 !== 0 || slotBytes < SLOT_HEADER_BYTES + payloadBytes(format, maxPoints))
    throw fault('bad-header', 24, `slots of ${slotBytes} bytes for frames of ${maxPoints} points`);
  const framesPerSecond = view.getFloat32(32, true);
  if (!(framesPerSecond >= 0 && framesPerSecond <= 1000))
    throw fault('bad-header', 32, `${framesPerSecond} frames a second`);
  const header = { format, slots, slotBytes, maxPoints, framesPerSecond, pid: word(36) };
  if (fileBytes(header) !== size)
    throw fault('bad-header', 20, `${slots} slots of ${slotBytes} bytes in a file of ${size}`);
  return header;
}

/** The lock of the slot of a complete frame. */
export function completeLock(frame: number): number {
  return sequence32Of(frame * 2);
}

/** The lock of the slot of a frame that is being written. */
export function writingLock(frame: number): number {
  return sequence32Of(frame * 2 - 1);
}

/** Writes everything in a slot's header except for the lock. */
export function writeFrameHeader(bytes: Uint8Array, frame: number, header: FrameHeader): void {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const { capturedAtMs, width, height, pose, lens, latencyTest, depthUnit } = header;
  const position = pose?.position ?? { x: 0, y: 0, z: 0 };
  const orientation = pose?.orientation ?? { x: 0, y: 0, z: 0, w: 0 };
  const camera = lens ?? { fx: 0, fy: 0, cx: 0, cy: 0 };
  view.setUint32(4, frame, true);
  view.setBigUint64(8, capturedAtMs === null ? 0n : BigInt(Math.round(capturedAtMs * 1e6)), true);
  view.setUint32(16, width, true);
  view.setUint32(20, height, true);
  const flags = (pose === null ? 0 : HAS_POSE) | (lens === null ? 0 : HAS_LENS);
  view.setUint32(24, flags | (latencyTest ? IS_LATENCY_TEST : 0), true);
  view.setUint32(28, 0, true);
  [
    position.x,
    position.y,
    position.z,
    orientation.x,
    orientation.y,
    orientation.z,
    orientation.w,
    camera.fx,
    camera.fy,
    camera.cx,
    camera.cy,
  ].forEach((value, i) => {
    view.setFloat64(32 + i * 8, value, true);
  });
  view.setFloat32(120, depthUnit, true);
  view.setUint32(124, 0, true);
}

/**
 * @param at the slot's offset in the file, for errors
 * @throws {SharedMemoryError} `bad-frame`
 */
export function parseFrameHeader(
  bytes: Uint8Array,
  { format, maxPoints }: CloudHeader,
  file: string,
  at: number,
): FrameHeader {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const fault = (offset: number, detail: string) =>
    new SharedMemoryError('bad-frame', file, at + offset, detail);
  const [width, height] = [view.getUint32(16, true), view.getUint32(20, true)];
  if (height < 1 || width * height > maxPoints)
    throw fault(16, `${width} × ${height} points, ${maxPoints} are the most`);
  const flags = view.getUint32(24, true);
  const numbers = Array.from({ length: 11 }, (_, i) => view.getFloat64(32 + i * 8, true));
  const [px, py, pz, qx, qy, qz, qw, fx, fy, cx, cy] = numbers as [
    ...[number, number, number],
    ...[number, number, number, number],
    ...[number, number, number, number],
  ];
  let pose: Pose | null = null;
  if ((flags & HAS_POSE) !== 0) {
    const norm = Math.hypot(qx, qy, qz, qw);
    if (![px, py, pz].every(Number.isFinite)) throw fault(32, 'a position that is not finite');
    if (!(Math.abs(norm - 1) < 0.01)) throw fault(56, 'an orientation that is not a unit quaternion');
    pose = {
      position: { x: px, y: py, z: pz },
      orientation: { x: qx / norm, y: qy / norm, z: qz / norm, w: qw / norm },
    };
  }
  const lens = (flags & HAS_LENS) === 0 ? null : { fx, fy, cx, cy };
  if (lens !== null && !(fx > 0 && fy > 0 && [fx, fy, cx, cy].every(Number.isFinite)))
    throw fault(88, 'impossible focal lengths or principal point');
  if (lens === null && format !== 'points')
    throw fault(24, 'depth without focal lengths and principal point');
  const depthUnit = view.getFloat32(120, true);
  if (format === 'depth16' && !(depthUnit > 0 && depthUnit <= 1))
    throw fault(120, `${depthUnit} metres a unit of depth`);
  const captureNs = view.getBigUint64(8, true);
  return {
    capturedAtMs: captureNs === 0n ? null : Number(captureNs) / 1e6,
    width,
    height,
    pose,
    lens,
    latencyTest: (flags & IS_LATENCY_TEST) !== 0,
    depthUnit: format === 'depth16' ? depthUnit : 0,
  };
}

function align64(bytes: number): number {
  return Math.ceil(bytes / 64) * 64;
}
