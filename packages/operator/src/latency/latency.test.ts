import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { FrameLatency } from './frame-latency.ts';
import { LatencyTest } from './latency-test.ts';
import { SampleWindow } from './sample-window.ts';

describe('LatencyTest', () => {
  test('first points and whole cloud are timed separately', () => {
    const latency = new LatencyTest();
    expect(latency.start(1000)).toBe(1);
    latency.onPacket(false, 5, 150, 300, 0);
    expect(latency.wantsTime).toBe(false);
    latency.onPacket(true, 6, 150, 300, 1030);
    expect(latency.wantsTime).toBe(true);
    expect(latency.onDrawn(1040)).toBe(null);
    expect(latency.wantsTime).toBe(false);
    latency.onPacket(true, 6, 150, 300, 1048);
    expect(latency.onDrawn(1056)).toEqual({
      id: 1,
      startedAtMs: 1000,
      firstMs: 40,
      mtpMs: 56,
      arrivedMs: 48,
      points: 300,
      totalPoints: 300,
      frameNumber: 6,
    });
    expect(latency.runningId).toBe(null);
  });

  test('lost packets: the last green points received count, once the next frame begins', () => {
    const latency = new LatencyTest();
    latency.start(0);
    latency.onPacket(true, 6, 150, 450, 0);
    latency.onDrawn(30);
    latency.onPacket(true, 6, 150, 450, 0);
    latency.onDrawn(46);
    latency.onDrawn(62);
    latency.onPacket(false, 7, 150, 450, 0);
    expect(latency.onDrawn(78)).toMatchObject({ firstMs: 30, mtpMs: 46, points: 300, totalPoints: 450 });
  });

  test('lost packets, and the next frame begins in the same display frame', () => {
    const latency = new LatencyTest();
    latency.start(0);
    latency.onPacket(true, 6, 150, 450, 0);
    latency.onPacket(false, 7, 150, 450, 0);
    expect(latency.onDrawn(30)).toMatchObject({ firstMs: 30, mtpMs: 30, points: 150 });
  });

  test('a late packet of the previous frame does not end a test, and a second green frame does not count', () => {
    const latency = new LatencyTest();
    latency.start(0);
    latency.onPacket(true, 0, 150, 300, 0);
    latency.onPacket(false, 0xffffffff, 150, 300, 0);
    expect(latency.onDrawn(20)).toBe(null);
    latency.onPacket(true, 1, 150, 300, 0);
    expect(latency.onDrawn(30)).toBe(null);
    latency.onPacket(true, 0, 150, 300, 0);
    expect(latency.onDrawn(40)).toMatchObject({ points: 300, mtpMs: 40 });
  });

  test('without a test no display frame needs timing', () => {
    const latency = new LatencyTest();
    latency.onPacket(true, 6, 150, 150, 0);
    expect(latency.wantsTime).toBe(false);
    latency.start(0);
    latency.cancel();
    latency.onPacket(true, 7, 150, 150, 0);
    expect(latency.onDrawn(10)).toBe(null);
  });
});

describe('FrameLatency', () => {
  const age = (captureUs: number, nowMs: number) => nowMs - captureUs / 1000;

  test('a frame counts when its last points are drawn', () => {
    const latency = new FrameLatency(age);
    latency.onPacket(1, 0, 150, 300, 12);
    latency.onDrawn(20);
    expect(latency.distribution).toBe(null);
    latency.onPacket(1, 0, 150, 300, 25);
    latency.onDrawn(36);
    expect(latency.distribution?.max).toBe(36);
    expect(latency.stages).toEqual({
      ...{ frames: 1, framesSeen: 1, firstPacketMs: 12, furtherPacketsMs: 13, drawMs: 11, totalMs: 36 },
    });
  });

  test('a frame that lost packets counts by the last one received', () => {
    const latency = new FrameLatency(age);
    latency.onPacket(1, 0, 150, 450, 10);
    latency.onDrawn(20);
    latency.onPacket(2, 33_000, 150, 150, 45);
    latency.onDrawn(50);
    expect(latency.distribution).toMatchObject({ p50: 17, max: 20 });
    latency.onPacket(3, 66_000, 150, 450, 80);
    latency.onPacket(4, 99_000, 150, 150, 120);
    latency.onDrawn(170);
    expect(latency.distribution?.max).toBe(104);
  });

  test('without the robot’s clock there are no samples', () => {
    const latency = new FrameLatency(() => null);
    latency.onPacket(1, 0, 150, 150, 9);
    latency.onDrawn(20);
    expect([latency.distribution, latency.stages]).toEqual([null, null]);
  });

  test('the stages add up to the latency, whatever arrives and however late', () => {
    const step = fc.record({
      ...{ frame: fc.integer({ min: 0, max: 20 }), points: fc.constantFrom(50, 100, 150) },
      ...{ waitMs: fc.integer({ min: 0, max: 40 }), draw: fc.boolean() },
    });
    fc.assert(
      fc.property(
        fc.array(step, { maxLength: 80 }),
        fc.integer({ min: -500, max: 500 }),
        (steps, offsetMs) => {
          const ages: number[] = [];
          const latency = new FrameLatency((captureUs, nowMs) => {
            ages.push(nowMs - captureUs / 1000 + offsetMs);
            return ages.at(-1) ?? null;
          });
          let nowMs = 1000;
          for (const { frame, points, waitMs, draw } of steps) {
            nowMs += waitMs;
            latency.onPacket(frame, frame * 20_000, points, 150, nowMs - 3);
            if (draw) latency.onDrawn(nowMs);
          }
          const { stages } = latency;
          if (stages === null) {
            expect(ages).toEqual([]);
            return;
          }
          const { frames, firstPacketMs, furtherPacketsMs, drawMs, totalMs } = stages;
          const last = ages.slice(-frames);
          expect(totalMs).toBeCloseTo(last.reduce((sum, age) => sum + age, 0) / frames, 6);
          expect(firstPacketMs + furtherPacketsMs + drawMs).toBeCloseTo(totalMs, 9);
          expect(furtherPacketsMs).toBeGreaterThanOrEqual(0);
          expect(drawMs).toBeGreaterThanOrEqual(0);
        },
      ),
      { seed: 21, numRuns: 500 },
    );
  });
});

describe('SampleWindow', () => {
  test('nearest-rank percentiles of the last samples', () => {
    const window = new SampleWindow(100);
    expect(window.distribution()).toBe(null);
    for (let i = 1000; i > 0; i--) window.add(i);
    expect(window.length).toBe(100);
    expect(window.distribution()).toEqual({ count: 100, p50: 50, p95: 95, p99: 99, max: 100 });
    window.clear();
    window.add(7);
    expect(window.distribution()).toEqual({ count: 1, p50: 7, p95: 7, p99: 7, max: 7 });
  });
});
