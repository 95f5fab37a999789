import { emptyPlacement } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { BATCH_BYTES, Batch } from '../cloud/batch.ts';
import { KEY_FRAME_BYTES, KeyFrame } from './key-frame.ts';
import { KeyFrameFeed } from './key-frame-feed.ts';

const LOOK = { imageExtent: 2, unit: 0.002, cover: 2 };
const GRID = { width: 40, height: 20, fx: 20, fy: 21, cx: 19.5, cy: 9.5 };

class Sink {
  free = 1;
  readonly sent: KeyFrame[] = [];
  takeFrame(): KeyFrame | null {
    return this.free-- > 0 ? new KeyFrame(new ArrayBuffer(KEY_FRAME_BYTES)) : null;
  }
  sendFrame(frame: KeyFrame): void {
    this.free++;
    this.sent.push(frame);
  }
}

/** A batch with points of one frame, from byte `offset` on. */
function points(
  frameNumber: number,
  offset: number,
  count: number,
  total: number,
  latencyTest = false,
): Batch {
  const batch = new Batch(new ArrayBuffer(BATCH_BYTES));
  for (let i = 0; i < count; i++) batch.points.set([offset / 8 + i, -1, 1000, -1], i * 4);
  const header = { frameNumber, frameLength: total * 8, sequenceOffset: offset, sequenceLength: count * 8 };
  batch.add(header, { ...emptyPlacement(), latencyTest }, count, 0, LOOK);
  return batch;
}

describe('KeyFrameFeed', () => {
  test('collects a frame from its packets, and waits before it begins another', () => {
    const sink = new Sink();
    const feed = new KeyFrameFeed(sink);
    feed.take(points(1, 0, 3, 5), 1000);
    feed.take(points(1, 24, 2, 5), 1010);
    expect(sink.sent.length).toBe(1);
    const [frame] = sink.sent as [KeyFrame];
    expect([frame.samples, frame.isTiles, frame.arrivedMs]).toEqual([5, false, 1000]);
    expect(frame.unit).toBeCloseTo(0.002, 9);
    expect([...frame.shorts.subarray(16, 20)]).toEqual([4, -1, 1000, -1]);
    feed.take(points(2, 0, 5, 5), 1100);
    expect(sink.sent.length).toBe(1);
    feed.take(points(3, 0, 5, 5), 1250);
    expect(sink.sent.length).toBe(2);
  });

  test('a frame whose end is lost ends with the next one; one whose beginning is lost is not taken', () => {
    const sink = new Sink();
    const feed = new KeyFrameFeed(sink);
    feed.take(points(1, 24, 2, 5), 1000);
    feed.take(points(2, 0, 3, 5), 1100);
    feed.take(points(1, 24, 2, 5), 1110);
    expect(sink.sent).toEqual([]);
    feed.take(points(3, 0, 3, 5), 1150);
    expect(sink.sent.map(({ samples }) => samples)).toEqual([3]);
  });

  test('leaves out the green frame of a latency test', () => {
    const sink = new Sink();
    const feed = new KeyFrameFeed(sink);
    feed.take(points(1, 0, 5, 5, true), 1000);
    expect(sink.sent).toEqual([]);
    feed.take(points(2, 0, 5, 5), 1010);
    expect(sink.sent.length).toBe(1);
  });

  test('takes nothing while no buffer is free', () => {
    const sink = new Sink();
    sink.free = 0;
    const feed = new KeyFrameFeed(sink);
    feed.take(points(1, 0, 5, 5), 1000);
    expect(sink.sent).toEqual([]);
  });

  test('takes a tile’s pixels at their places in the image, without those beyond its edge and those not seen', () => {
    const sink = new Sink();
    const feed = new KeyFrameFeed(sink);
    const batch = new Batch(new ArrayBuffer(BATCH_BYTES));
    // Tiles 4 and 5 of 3 × 2: the second row begins with tile 3.
    batch.samples.fill(0x8000_3c00, 0, 512);
    batch.samples[1] = 0;
    const header = { frameNumber: 1, frameLength: 800, sequenceOffset: 0, sequenceLength: 800 };
    batch.addTiles(header, emptyPlacement(), 4, 2, 0, LOOK, GRID);
    feed.take(batch, 0);
    const [frame] = sink.sent as [KeyFrame];
    // 16 × 4 pixels of one, 8 × 4 of the other, one of which was not seen.
    expect(frame.samples).toBe(16 * 4 + 8 * 4 - 1);
    expect([frame.words[0], frame.words[1]]).toEqual([16 | (16 << 16), 0x8000_3c00]);
    expect(frame.lens(1)).toBe(21);
  });
});
