import { expect, test } from 'vitest';
import { durationWords, recordingBytesPerSecond, sizeWords } from './recording-rate.ts';

const camera = { points: 230_400, framesPerSecond: 30, pictures: false, videoBitsPerSecond: 0 };

test('counts 16 bytes per point, at the lower of the recording’s and the camera’s rate', () => {
  const rate = (captured: number, sent: number) =>
    recordingBytesPerSecond({ ...camera, perSecond: { captured, sent } }) - 50_000;
  expect(rate(5, 0)).toBe(5 * 230_400 * 16);
  expect(rate(0, 10)).toBe(10 * 230_400 * 16);
  expect(rate(120, 120)).toBe(60 * 230_400 * 16);
  expect(rate(0, 0)).toBe(0);
  const pictures = { ...camera, perSecond: { captured: 0, sent: 0 }, pictures: true };
  expect(recordingBytesPerSecond(pictures)).toBe(425_000);
  expect(recordingBytesPerSecond({ ...pictures, pictures: false, videoBitsPerSecond: 8e6 })).toBe(1_050_000);
});

test('formats sizes for people', () => {
  expect([50_000, 999_999, 36_914_000, 1_230_000_000, 4e9].map(sizeWords)).toEqual([
    ...['50 kB', '1000 kB', '37 MB', '1.2 GB', '4 GB'],
  ]);
  expect([0.5, 108, 200, 80_000].map(durationWords)).toEqual(['0 s', '108 s', '3 min', '22 h']);
});
