import { expect, test } from 'vitest';
import { captureMsOf } from './video-feed.ts';

const rtpOf = (ms: number) => Math.floor(ms * 90) % 2 ** 32;

test('a frame’s RTP timestamp is its capture instant on the robot’s clock', () => {
  const frame = { rtpTimestamp: rtpOf(61_000), capturedAtMs: 5 };
  expect(captureMsOf(frame, 60_000, 1040)).toBe(61_000);
});

test('without it, the browser’s estimate counts, or else the present time', () => {
  expect(captureMsOf({ rtpTimestamp: null, capturedAtMs: 970 }, 60_000, 1000)).toBe(60_970);
  expect(captureMsOf({ rtpTimestamp: null, capturedAtMs: null }, 60_000, 1000)).toBe(61_000);
});

test('refuses timestamps of a sender that counts time otherwise', () => {
  const at = (rtpTimestamp: number) => captureMsOf({ rtpTimestamp, capturedAtMs: null }, 100_000, 0);
  expect(at(rtpOf(101_100))).toBe(null);
  expect(at(rtpOf(39_000))).toBe(null);
  expect(at(rtpOf(100_900))).toBe(100_900);
  expect(at(rtpOf(41_000))).toBe(41_000);
});
