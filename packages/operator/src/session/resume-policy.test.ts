import { describe, expect, test } from 'vitest';
import {
  LOST_AFTER_CHANGE_MS,
  LOST_AFTER_MS,
  RESUME_EVERY_MS,
  ResumePolicy,
  UNANSWERED_MS,
} from './resume-policy.ts';

/** Decides every 250 ms up to `toMs`. @returns the times of the requests */
function run(policy: ResumePolicy, fromMs: number, toMs: number, each: (ms: number) => boolean = () => true) {
  const asked: number[] = [];
  for (let ms = fromMs; ms <= toMs; ms += 250) if (policy.decide(ms, each(ms))) asked.push(ms);
  return asked;
}

describe('ResumePolicy', () => {
  test('asks once a second while nothing is heard, and stops with the first sign of life', () => {
    const policy = new ResumePolicy();
    policy.begin(0);
    expect(run(policy, 0, 5000)).toEqual([1000, 2000, 3000, 4000, 5000]);
    expect(policy.lost(5000)).toBe(true);
    policy.onHeard(5100);
    expect(policy.lost(5100)).toBe(false);
    expect(run(policy, 5250, 6000)).toEqual([]);
    expect(LOST_AFTER_MS).toBe(RESUME_EVERY_MS);
  });

  test('a session that is received normally makes no requests', () => {
    const policy = new ResumePolicy();
    policy.begin(0);
    const asked = run(policy, 0, 60_000, (ms) => {
      policy.onHeard(ms);
      policy.onAnswered(ms);
      return true;
    });
    expect(asked).toEqual([]);
  });

  test('the robot is heard but never answers: it does not hear us', () => {
    const policy = new ResumePolicy();
    policy.begin(0);
    const asked = run(policy, 0, 4000, (ms) => {
      policy.onHeard(ms);
      return true;
    });
    expect(asked).toEqual([UNANSWERED_MS, UNANSWERED_MS + 1000]);
  });

  test('after an outage answers get the full time limit again', () => {
    const policy = new ResumePolicy();
    policy.begin(0);
    run(policy, 0, 20_000);
    policy.onHeard(20_100);
    expect(policy.lost(20_100)).toBe(false);
    policy.onHeard(20_900);
    expect(run(policy, 20_250, 21_500)).toEqual([]);
  });

  test('after a change of the network the path counts as lost sooner', () => {
    const policy = new ResumePolicy();
    policy.begin(0);
    policy.onNetworkChange(0);
    expect(policy.decide(LOST_AFTER_CHANGE_MS - 1, true)).toBe(false);
    expect(policy.decide(LOST_AFTER_CHANGE_MS, true)).toBe(true);
  });

  test('makes no request without signaling, and one at once when it is back', () => {
    const policy = new ResumePolicy();
    policy.begin(0);
    expect(run(policy, 0, 9000, () => false)).toEqual([]);
    expect(policy.decide(9100, true)).toBe(true);
    policy.onSignalingBack();
    expect(policy.decide(9200, true)).toBe(true);
  });

  test('a page that was asleep waits for the full time limit before a request', () => {
    const policy = new ResumePolicy();
    policy.begin(0);
    policy.decide(0, true);
    expect(policy.decide(600_000, true)).toBe(false);
    expect(policy.decide(600_000 + LOST_AFTER_MS, true)).toBe(true);
  });
});
