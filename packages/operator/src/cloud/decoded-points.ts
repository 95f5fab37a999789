import { bytesOfPoints, type Placement, type PointPacketHeader } from '@farpoint/protocol';
import { BATCH_POINTS, type PointLook } from './batch.ts';
import type { BatchWriter } from './packet-decoder.ts';

/**
 * Hands a decoded packet's points on, one of every `writer.every`. A packet with more points than fit into a batch
 * continues in the next ones: each part has its own place in the frame, like a packet.
 */
export class DecodedPoints {
  readonly #part: PointPacketHeader = {
    frameNumber: 0,
    frameLength: 0,
    sequenceOffset: 0,
    sequenceLength: 0,
  };

  /** @param points 4 int16 each, the packet's points only */
  write(
    points: Int16Array,
    header: PointPacketHeader,
    placement: Placement,
    receivedAtMs: number,
    look: PointLook,
    writer: BatchWriter,
  ): void {
    const { every } = writer;
    const total = points.length / 4;
    const part = this.#part;
    part.frameNumber = header.frameNumber;
    part.frameLength = header.frameLength;
    for (let first = 0; first < total; ) {
      const came = Math.min(total - first, BATCH_POINTS * every);
      const drawn = Math.ceil(came / every);
      const batch = writer.batchFor(drawn);
      if (batch === null) {
        writer.drop('no-buffer');
        return;
      }
      const at = batch.pointCount * 4;
      if (every === 1) batch.points.set(points.subarray(first * 4, (first + came) * 4), at);
      else copyThinned(points, first, came, every, batch.points, at);
      part.sequenceOffset = header.sequenceOffset + bytesOfPoints(first);
      part.sequenceLength = bytesOfPoints(came);
      batch.add(part, placement, drawn, receivedAtMs, look);
      first += came;
    }
  }
}

/** Copies one of every `every` of the `came` points from point `first` on to index `at`. */
export function copyThinned(
  from: Int16Array,
  first: number,
  came: number,
  every: number,
  into: Int16Array,
  at: number,
): void {
  let target = at;
  for (let begin = 0; begin < came; begin += every) {
    const source = (first + begin + chosenOf(Math.min(every, came - begin), begin)) * 4;
    into[target] = from[source] as number;
    into[target + 1] = from[source + 1] as number;
    into[target + 2] = from[source + 2] as number;
    into[target + 3] = from[source + 3] as number;
    target += 4;
  }
}

/**
 * Picks pseudo-randomly which of `count` points is drawn. Coded points come in rows of 16, so every 16th point would
 * form lines with gaps between them.
 */
function chosenOf(count: number, begin: number): number {
  const mixed = Math.imul(begin ^ (begin >>> 7), 0x9e37_79b1);
  return (Math.imul(mixed ^ (mixed >>> 15), 0x85eb_ca6b) >>> 8) % count;
}
