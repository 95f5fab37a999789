import { describe, expect, it } from 'vitest';
import { StageTimer } from './stage-timer.ts';

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
