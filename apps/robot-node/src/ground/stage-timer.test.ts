import { describe, expect, it } from 'vitest';
import { StageTimer } from './stage-timer.ts';

describe('StageTimer', () => {
  it('gives means since the last query, and the previous mean if there was nothing new', () => {
    const timer = new StageTimer();
    timer.add('packMs', 2);
    timer.add('packMs', 4);
    timer.add('sendMs', 10);
    expect(timer.take()).toEqual({ captureMs: 0, sampleMs: 0, packMs: 3, sendMs: 10 });
    timer.add('sendMs', 20);
    expect(timer.take()).toEqual({ captureMs: 0, sampleMs: 0, packMs: 3, sendMs: 20 });
  });
});
