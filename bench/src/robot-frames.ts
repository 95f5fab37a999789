/**
 * What happened to a robot's frames: the robot's log of them, the colours in which they arrived, and the memory they
 * took.
 */
import { readFileSync } from 'node:fs';
import {
  emptyPointPacketHeader,
  POINT_PACKET_HEADER_BYTES,
  pointsOfBytes,
  readPointPacketHeader,
} from '@farpoint/protocol';

/** The colours of the frames that arrived. A frame with more than one colour is torn. */
export class FrameColours {
  torn = 0;
  packets = 0;
  readonly #header = emptyPointPacketHeader();
  readonly #colours = new Map<number, number>();

  add(payload: Buffer): void {
    const view = new DataView(payload.buffer, payload.byteOffset, payload.byteLength);
    if (readPointPacketHeader(view, this.#header) !== null) return;
    this.packets++;
    const { frameNumber, sequenceLength } = this.#header;
    const points = pointsOfBytes(sequenceLength);
    for (let i = 0; i < points; i++)
      this.#see(frameNumber, view.getUint16(POINT_PACKET_HEADER_BYTES + points * 6 + i * 2, true));
    if (this.#colours.size > 100) this.#colours.delete(this.#colours.keys().next().value as number);
  }

  #see(frame: number, colour: number): void {
    const first = this.#colours.get(frame);
    if (first === undefined) {
      this.#colours.set(frame, colour);
    } else if (first !== colour && first >= 0) {
      this.torn++;
      this.#colours.set(frame, -1);
    }
  }
}

export interface LoggedFrame {
  capturedMs: number;
  readyMs: number;
  points: number;
}

export function readFrameLog(path: string): LoggedFrame[] {
  const [header, ...lines] = readFileSync(path, 'utf8').trimEnd().split('\n');
  if (header !== 'frameNumber,capturedMs,readyMs,points') throw new Error(`${path}: not a frame log`);
  return lines.map((line) => {
    const [, capturedMs, readyMs, points] = line.split(',').map(Number) as [number, number, number, number];
    return { capturedMs, readyMs, points };
  });
}

/** Peak memory of a process, 10^6 bytes (Linux). */
export function residentPeakMb(pid: number): number {
  const line = /^VmHWM:\s+(\d+) kB$/m.exec(readFileSync(`/proc/${pid}/status`, 'utf8'));
  return Math.round((Number(line?.[1] ?? Number.NaN) * 1024) / 1e6);
}
