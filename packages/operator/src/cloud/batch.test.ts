import { emptyPlacement } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { BATCH_BYTES, BATCH_PACKETS, BATCH_POINTS, Batch } from './batch.ts';
import { BatchPool } from './batch-pool.ts';

const LOOK = { imageExtent: 2, unit: 0.001, cover: 2 };

describe('Batch', () => {
  test('the page reads what the worker wrote', () => {
    const worker = new Batch(new ArrayBuffer(BATCH_BYTES));
    const header = {
      frameNumber: 4_000_000_000,
      frameLength: 2400,
      sequenceOffset: 1200,
      sequenceLength: 80,
    };
    const placement = emptyPlacement();
    placement.pose.position.y = 1.5;
    placement.pose.orientation.z = 0.25;
    placement.captureTimeUs = 4_294_967_295;
    placement.latencyTest = true;
    worker.add({ ...header, sequenceLength: 8 }, emptyPlacement(), 1, 0, LOOK);
    worker.add(header, placement, 4, 1_795_000_000_000.25, { imageExtent: 0.5, unit: 0.25, cover: 3 });
    const page = new Batch(worker.buffer, worker.packets, worker.pointCount);
    expect(page.pointCount).toBe(5);
    expect(page.room).toBe(BATCH_POINTS - 5);
    expect(page.frameNumber(1)).toBe(4_000_000_000);
    expect(page.frameLength(1)).toBe(2400);
    expect(page.sequenceOffset(1)).toBe(1200);
    expect([page.pointsOf(1), page.pointsCame(1), page.sequenceLength(1)]).toEqual([4, 10, 80]);
    expect([page.unit(1), page.cover(1)]).toEqual([0.25, 3]);
    expect(page.imageExtent(1)).toBe(0.5);
    expect(page.captureTimeUs(1)).toBe(4_294_967_295);
    expect(page.receivedAtMs(1)).toBe(1_795_000_000_000.25);
    expect([page.isLatencyTest(0), page.isLatencyTest(1)]).toEqual([false, true]);
    expect(Array.from({ length: 7 }, (_, i) => page.poseComponent(1, i))).toEqual([0, 1.5, 0, 0, 0, 0.25, 1]);
  });

  test('the page reads tiles and the image that they belong to', () => {
    const worker = new Batch(new ArrayBuffer(BATCH_BYTES));
    const header = { frameNumber: 1, frameLength: 800, sequenceOffset: 0, sequenceLength: 800 };
    const grid = { width: 640, height: 481, fx: 400.5, fy: 399.5, cx: 320, cy: 240.25 };
    worker.samples[256 * 3 - 1] = 0xf800_3c00;
    worker.addTiles(header, emptyPlacement(), 40, 3, 5, LOOK, grid);
    worker.add(header, emptyPlacement(), 2, 5, LOOK);
    const page = new Batch(worker.buffer, worker.packets, worker.pointCount);
    expect([page.firstTile(0), page.tilesOf(0), page.pointsOf(0), page.pointsCame(0)]).toEqual([
      40, 3, 384, 100,
    ]);
    expect([page.tilesOf(1), page.pointsOf(1)]).toEqual([0, 2]);
    const read = { width: 0, height: 0, fx: 0, fy: 0, cx: 0, cy: 0 };
    page.readGrid(0, read);
    expect(read).toEqual(grid);
    expect(page.samples[256 * 3 - 1]).toBe(0xf800_3c00);
    expect(page.room).toBe(BATCH_POINTS - 386);
  });

  test('holds a full points64 packet for each entry', () => {
    const batch = new Batch(new ArrayBuffer(BATCH_BYTES));
    expect(batch.points.length).toBeGreaterThanOrEqual(BATCH_PACKETS * 150 * 4);
    for (let i = 0; i < BATCH_PACKETS; i++) {
      expect(batch.full).toBe(false);
      batch.add(
        { frameNumber: 0, frameLength: 8, sequenceOffset: 0, sequenceLength: 8 },
        emptyPlacement(),
        1,
        0,
        LOOK,
      );
    }
    expect(batch.full).toBe(true);
  });
});

describe('BatchPool', () => {
  test('lends a limited number of buffers until they come back', () => {
    const pool = new BatchPool(2);
    const [a, b] = [pool.take(), pool.take()];
    pool.sent();
    pool.sent();
    expect(pool.take()).toBe(null);
    pool.giveBack(b!.buffer);
    expect(pool.out).toBe(1);
    expect(pool.take()?.buffer).toBe(b!.buffer);
    pool.giveBack(new ArrayBuffer(8));
    expect(pool.out).toBe(1);
    pool.giveBack(a!.buffer);
    expect(pool.out).toBe(0);
    // No more buffers than were lent can come back.
    pool.giveBack(new ArrayBuffer(BATCH_BYTES));
    expect(pool.take()?.buffer).toBe(a!.buffer);
    expect(pool.take()).toBe(null);
  });
});
