import type { Batch } from '@farpoint/operator';
import type { FrameWindow, WindowDrop } from './frame-window.ts';
import type { PointRing } from './point-ring.ts';

/** What happens to a batch's packets. */
export interface UploadEvents {
  /** A packet of a newer frame than any before. */
  beginFrame(batch: Batch, packet: number): void;
  /** A packet is drawn; its points begin at the batch's point `at`. */
  draw(batch: Batch, packet: number, at: number): void;
  drop(reason: WindowDrop): void;
}

/** Writes a batch's points to the GPU. Adjacent packets are written at once. */
export function uploadPoints(batch: Batch, window: FrameWindow, ring: PointRing, events: UploadEvents): void {
  const move = window.reserve(batch.pointCount);
  if (move !== null) ring.relocate(move);
  let first = 0;
  let count = 0;
  let vertex = window.tail;
  let at = 0;
  for (let packet = 0; packet < batch.packets; packet++) {
    const points = batch.pointsOf(packet);
    const before = window.newestFrame;
    const isTiles = batch.tilesOf(packet) > 0;
    const drop = isTiles ? 'superseded' : accept(batch, packet, points, window);
    if (drop === null) {
      if (window.newestFrame !== before) events.beginFrame(batch, packet);
      events.draw(batch, packet, at);
      count += points;
    } else {
      events.drop(drop);
      if (count > 0) ring.write(batch.points, first, count, vertex);
      first = at + points;
      count = 0;
      vertex = window.tail;
    }
    at += points;
  }
  if (count > 0) ring.write(batch.points, first, count, vertex);
}

function accept(batch: Batch, packet: number, points: number, window: FrameWindow): WindowDrop | null {
  return window.accept(
    batch.frameNumber(packet),
    batch.frameLength(packet),
    batch.sequenceOffset(packet),
    batch.sequenceLength(packet),
    points,
  );
}
