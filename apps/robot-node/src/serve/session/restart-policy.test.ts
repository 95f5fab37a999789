import { describe, expect, it } from 'vitest';
import { RestartPolicy } from './restart-policy.ts';

describe('RestartPolicy', () => {
  it('offers at once, then waits 3 s at most for the answer', () => {
    const policy = new RestartPolicy();
    expect(policy.request(1000)).toBe(true);
    expect(policy.request(3999)).toBe(false);
    expect(policy.request(4000)).toBe(true);
  });

  it('keeps 400 ms between answered offers', () => {
    const policy = new RestartPolicy();
    policy.request(0);
    policy.onAnswer();
    expect(policy.request(399)).toBe(false);
    expect(policy.request(400)).toBe(true);
  });

  it('makes a bounded number of offers for endless requests', () => {
    const policy = new RestartPolicy();
    let offers = 0;
    for (let ms = 0; ms < 60_000; ms++) {
      if (!policy.request(ms)) continue;
      offers++;
      policy.onAnswer();
    }
    expect(offers).toBe(150);
    expect(policy.refused).toBe(60_000 - offers);
  });
});
