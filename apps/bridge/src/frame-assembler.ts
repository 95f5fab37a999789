/**
 * Assembles frames from packets, by frame number and offset. Whatever is lost, duplicated or out of order, each point
 * lands in its own frame and place or nowhere. Pure: bytes and time are arguments.
 */
import {
  bytesOfPoints,
  emptyPointPacketHeader,
  POINT_PACKET_HEADER_BYTES,
  type PointPacketFault,
  pointsOfBytes,
  readPointPacketHeader,
  sequenceDelta32,
} from '@farpoint/protocol';
import { type FrameBuffer, FrameBuffers } from './frame-buffers.ts';

/** Why a packet adds nothing to a frame. */
export type AssemblyDrop =
  | PointPacketFault
  | 'too-many-points' // its frame is larger than this bridge takes
  | 'inconsistent' // it says another length of its frame than the packets before
  | 'duplicate' // some of its points have come already
  | 'late'; // its frame has been given out

export interface AssembledFrame {
  frameNumber: number;
  /** N × 3 int16 coordinates, then N × u16 colours, little-endian: the bridge's streaming message. */
  bytes: Uint8Array;
  /** To be called once, when the bytes are no longer in use. Until then they are kept. */
  release: () => void;
  points: number;
  /** Number of points in the whole frame. */
  expectedPoints: number;
}

export interface AssemblerOptions {
  /** Larger frames are refused. */
  maxPoints: number;
  /** How long an overtaken frame waits for reordered packets, ms. */
  reorderMs: number;
}

interface OpenFrame {
  readonly number: number;
  readonly total: number;
  readonly buffer: FrameBuffer;
  points: number;
  /** When its last packet or one of a later frame was seen; `null` before that. */
  overtakenMs: number | null;
}

/** Maximum number of frames in progress. Beyond it, the oldest is emitted as it is. */
const MAX_OPEN = 3;
/** A frame number this far back is not a late frame: the robot has restarted its count. */
const RESTART_FRAMES = 300;

/**
 * A frame is emitted as soon as it is complete. An incomplete frame is emitted when a later frame is complete, or
 * `reorderMs` after its last packet or any packet of a later frame arrived.
 */
export class FrameAssembler {
  readonly drops: Partial<Record<AssemblyDrop, number>> = {};
  framesComplete = 0;
  framesPartial = 0;
  readonly #options: AssemblerOptions;
  readonly #emit: (frame: AssembledFrame) => void;
  readonly #header = emptyPointPacketHeader();
  readonly #buffers = new FrameBuffers(MAX_OPEN + 1);
  /** In order of frame number. */
  readonly #open: OpenFrame[] = [];
  #lastGiven: number | null = null;

  constructor(options: AssemblerOptions, emit: (frame: AssembledFrame) => void) {
    this.#options = options;
    this.#emit = emit;
  }

  /** @param payload an RTP payload: header, block, and possibly more @returns why it adds nothing, or `null` */
  accept(payload: Uint8Array, nowMs: number): AssemblyDrop | null {
    const drop = this.#accept(payload, nowMs);
    if (drop !== null) this.drops[drop] = (this.drops[drop] ?? 0) + 1;
    return drop;
  }

  /** When {@link expire} has something to do; `null` if it has not. */
  get nextDueMs(): number | null {
    let due: number | null = null;
    for (const { overtakenMs } of this.#open) {
      if (overtakenMs !== null && (due === null || overtakenMs < due)) due = overtakenMs;
    }
    return due === null ? null : due + this.#options.reorderMs;
  }

  /** Emits the frames that have waited long enough. */
  expire(nowMs: number): void {
    const last = this.#open.findLastIndex(
      ({ overtakenMs }) => overtakenMs !== null && nowMs - overtakenMs >= this.#options.reorderMs,
    );
    this.#giveOut(last + 1);
  }

  /** Discards frames in progress, for example when another robot is chosen. */
  clear(): void {
    for (const { buffer } of this.#open.splice(0)) this.#buffers.giveBack(buffer);
  }

  #accept(payload: Uint8Array, nowMs: number): AssemblyDrop | null {
    const header = this.#header;
    const fault = readPointPacketHeader(
      new DataView(payload.buffer, payload.byteOffset, payload.byteLength),
      header,
    );
    if (fault !== null) return fault;
    const total = pointsOfBytes(header.frameLength);
    if (total > this.#options.maxPoints) return 'too-many-points';
    const number = header.frameNumber;
    if (this.#lastGiven !== null) {
      const ahead = sequenceDelta32(number, this.#lastGiven);
      if (ahead <= -RESTART_FRAMES) {
        this.clear();
        this.#lastGiven = null;
      } else if (ahead <= 0) return 'late';
    }
    const frame = this.#frame(number, total);
    if (frame === null) return 'inconsistent';
    const first = pointsOfBytes(header.sequenceOffset);
    const count = pointsOfBytes(header.sequenceLength);
    const { seen, bytes } = frame.buffer;
    for (let i = first; i < first + count; i++) if (seen[i] !== 0) return 'duplicate';
    seen.fill(1, first, first + count);
    const from = POINT_PACKET_HEADER_BYTES;
    bytes.set(payload.subarray(from, from + 6 * count), 6 * first);
    bytes.set(payload.subarray(from + 6 * count, from + bytesOfPoints(count)), 6 * total + 2 * first);
    frame.points += count;
    const isLast = first + count === total;
    for (const other of this.#open) {
      const overtaken = other === frame ? isLast : sequenceDelta32(number, other.number) > 0;
      if (overtaken) other.overtakenMs ??= nowMs;
    }
    if (frame.points === total) this.#giveOut(this.#open.indexOf(frame) + 1);
    else if (this.#open.length > MAX_OPEN) this.#giveOut(this.#open.length - MAX_OPEN);
    return null;
  }

  /** @returns `null` if the frame has another length */
  #frame(number: number, total: number): OpenFrame | null {
    let at = this.#open.length;
    while (at > 0) {
      const before = this.#open[at - 1] as OpenFrame;
      const ahead = sequenceDelta32(number, before.number);
      if (ahead === 0) return before.total === total ? before : null;
      if (ahead > 0) break;
      at--;
    }
    const frame: OpenFrame = {
      number,
      total,
      buffer: this.#buffers.take(total),
      points: 0,
      overtakenMs: null,
    };
    this.#open.splice(at, 0, frame);
    return frame;
  }

  #giveOut(count: number): void {
    for (const frame of this.#open.splice(0, count)) {
      this.#lastGiven = frame.number;
      const giveBack = () => this.#buffers.giveBack(frame.buffer);
      // All packets of the frame were refused.
      if (frame.points === 0) {
        giveBack();
        continue;
      }
      const isWhole = frame.points === frame.total;
      if (isWhole) this.framesComplete++;
      else this.framesPartial++;
      this.#emit({
        frameNumber: frame.number,
        bytes: isWhole ? frame.buffer.bytes : compact(frame),
        release: giveBack,
        points: frame.points,
        expectedPoints: frame.total,
      });
    }
  }
}

/** The received points without gaps, in order, in memory of their own. */
function compact({ buffer: { bytes, seen }, points, total }: OpenFrame): Uint8Array {
  const out = new Uint8Array(bytesOfPoints(points));
  let to = 0;
  for (let from = 0; from < total; ) {
    if (seen[from] === 0) {
      from++;
      continue;
    }
    let end = from;
    while (end < total && seen[end] !== 0) end++;
    out.set(bytes.subarray(6 * from, 6 * end), 6 * to);
    out.set(bytes.subarray(6 * total + 2 * from, 6 * total + 2 * end), 6 * points + 2 * to);
    to += end - from;
    from = end;
  }
  return out;
}
