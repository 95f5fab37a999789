import { describe, expect, it } from 'vitest';
import { RateMeter } from './rate-meter.ts';
import { StageTimer } from './stage-timer.ts';

describe('RateMeter', () => {
  it('gives the growth per second over the last second', () => {
    const meter = new RateMeter<'packets'>();
    expect(meter.update({ packets: 100 }, 0)).toEqual({ packets: 0 });
    expect(meter.update({ packets: 150 }, 500)).toEqual({ packets: 100 });
    // From here on growth stops: a second later nothing is left of it.
    for (let ms = 600; ms < 1500; ms += 50) meter.update({ packets: 150 }, ms);
    expect(meter.update({ packets: 150 }, 1500)).toEqual({ packets: 0 });
  });

  it('never falls below zero', () => {
    const meter = new RateMeter<'packets'>();
    meter.update({ packets: 10 }, 0);
    expect(meter.update({ packets: 0 }, 100)).toEqual({ packets: 0 });
  });
});

describe('StageTimer', () => {
  it('gives means since it was last asked, and the last mean where nothing came', () => {
    const timer = new StageTimer();
    timer.add('packMs', 2);
    timer.add('packMs', 4);
    timer.add('sendMs', 10);
    expect(timer.take()).toEqual({ captureMs: 0, sampleMs: 0, packMs: 3, sendMs: 10 });
    timer.add('sendMs', 20);
    expect(timer.take()).toEqual({ captureMs: 0, sampleMs: 0, packMs: 3, sendMs: 20 });
  });
});
