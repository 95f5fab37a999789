import { describe, expect, it } from 'vitest';
import { ANSWER_WAIT_MS, RESTART_SPACING_MS, RestartPolicy } from './restart-policy.ts';

describe('RestartPolicy', () => {
  it('offers at once, then waits until the answer comes or counts as lost', () => {
    const policy = new RestartPolicy();
    expect(policy.request(1000)).toBe(true);
    expect(policy.request(1000 + ANSWER_WAIT_MS - 1)).toBe(false);
    expect(policy.request(1000 + ANSWER_WAIT_MS)).toBe(true);
  });

  it('keeps a minimum interval between answered offers', () => {
    const policy = new RestartPolicy();
    policy.request(0);
    policy.onAnswer();
    expect(policy.request(RESTART_SPACING_MS - 1)).toBe(false);
    expect(policy.request(RESTART_SPACING_MS)).toBe(true);
  });

  it('makes a bounded number of offers for endless requests', () => {
    const policy = new RestartPolicy();
    let offers = 0;
    for (let ms = 0; ms < 60_000; ms++) {
      if (!policy.request(ms)) continue;
      offers++;
      policy.onAnswer();
    }
    expect(offers).toBe(60_000 / RESTART_SPACING_MS);
    expect(policy.refused).toBe(60_000 - offers);
  });
});
