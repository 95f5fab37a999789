import { expect, it } from 'vitest';
import { KeyFrameLimit } from './key-frame-limit.ts';

it('passes the first request on at once, and the others together when the interval is over', () => {
  const limit = new KeyFrameLimit(300);
  expect(limit.request(1000)).toBe(0);
  expect(limit.request(1100)).toBe(200);
  expect(limit.request(1150)).toBeNull();
  limit.passed(1301);
  expect(limit.request(1302)).toBe(299);
  limit.passed(1601);
  expect(limit.request(1901)).toBe(0);
});
