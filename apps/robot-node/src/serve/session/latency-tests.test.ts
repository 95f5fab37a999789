import { beforeEach, expect, it } from 'vitest';
import type { SharedFrame } from '../../send/transport/shared-frame.ts';
import { LatencyTests } from './latency-tests.ts';

const frame = (latencyTest: boolean) => ({ frame: { latencyTest } }) as SharedFrame;
const green = () => frame(true);

let tests: LatencyTests;
beforeEach(() => {
  tests = new LatencyTests();
});

it('a green frame answers all waiting tests, once', () => {
  expect(tests.ask({ id: 1, commandMs: 10 })).toBe(true);
  expect(tests.ask({ id: 1, commandMs: 11 })).toBe(false);
  expect(tests.ask({ id: 2, commandMs: 12 })).toBe(true);
  expect(tests.answeredBy(frame(false))).toEqual([]);
  expect(tests.answeredBy(green()).map(({ id }) => id)).toEqual([1, 2]);
  expect(tests.answeredBy(green())).toEqual([]);
});

it('tests whose frame was lost wait for the next green frame', () => {
  tests.ask({ id: 1, commandMs: 10 });
  const [lost, sent] = [green(), green()];
  tests.answeredBy(lost);
  expect(tests.onLost(lost)).toBe(true);
  expect(tests.answeredBy(sent)).toHaveLength(1);
  tests.onSent(sent);
  expect(tests.onLost(sent)).toBe(false);
});

it('drops the oldest tests when too many wait', () => {
  for (let id = 0; id < 100; id++) tests.ask({ id, commandMs: id });
  expect(tests.answeredBy(green()).map(({ id }) => id)).toEqual(Array.from({ length: 16 }, (_, i) => 84 + i));
});
