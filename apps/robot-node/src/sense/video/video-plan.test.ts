import { describe, expect, it } from 'vitest';
import { VideoPlanner } from './video-plan.ts';

const large = { width: 1024, height: 768, framesPerSecond: 30, bitsPerSecond: 512_000 };

describe('VideoPlanner', () => {
  it('keeps the configured picture while the path carries its rate', () => {
    const planner = new VideoPlanner(large);
    expect(planner.plan(10e6)).toEqual(large);
    expect(planner.plan(400_000)).toEqual({ ...large, bitsPerSecond: 400_000 });
  });

  it('makes the picture smaller, then slower, and nothing at all in the end', () => {
    const planner = new VideoPlanner(large);
    const seen = [300, 150, 70, 60].map((kbit) => planner.plan(kbit * 1000));
    expect(seen).toEqual([
      { width: 768, height: 576, framesPerSecond: 30, bitsPerSecond: 300_000 },
      { width: 512, height: 384, framesPerSecond: 30, bitsPerSecond: 150_000 },
      { width: 512, height: 384, framesPerSecond: 15, bitsPerSecond: 70_000 },
      { width: 512, height: 384, framesPerSecond: 15, bitsPerSecond: 60_000 },
    ]);
    expect(planner.plan(59_000)).toBeNull();
  });

  it('does not change size back and forth around a bound', () => {
    const planner = new VideoPlanner(large);
    const widths = [340, 320, 340, 360, 440, 470, 480, 340].map((kbit) => planner.plan(kbit * 1000)?.width);
    expect(widths).toEqual([1024, 768, 768, 768, 768, 1024, 1024, 1024]);
  });

  it('returns to the configured picture with its rate, however low that is', () => {
    const planner = new VideoPlanner({ ...large, width: 1920, height: 1080, framesPerSecond: 60 });
    expect(planner.plan(512_000)?.width).toBe(1920);
    expect(planner.plan(200_000)?.width).toBeLessThan(1920);
    expect(planner.plan(512_000)?.width).toBe(1920);
  });

  it('makes even sides', () => {
    const planner = new VideoPlanner({ ...large, width: 962, height: 481 });
    for (const kbit of [500, 250, 150, 80]) {
      const plan = planner.plan(kbit * 1000);
      expect([plan!.width % 2, plan!.height % 2]).toEqual([0, 0]);
    }
  });
});
