import { expect, test } from 'vitest';
import { recordedVideo } from './recorded-videos.ts';

const frames = (...times: number[]) => times.map((ms) => ({ ms, bytes: 1000 }));

test('counts what a video has and what it lost, by the capture times', () => {
  const whole = Array.from({ length: 31 }, (_, i) => i * (1000 / 30) + (i % 2));
  expect(recordedVideo(frames(...whole), 30)).toEqual({
    ...{ frames: 31, lost: 0, keptShare: 1, framesPerSecond: 30, bytesPerSecond: 31_000 },
  });
  expect(recordedVideo(frames(0, 100, 400, 500), 10)).toMatchObject({
    frames: 4,
    lost: 2,
    keptShare: 0.6667,
  });
});

test('a video without frames kept nothing', () => {
  expect(recordedVideo([], 30)).toMatchObject({ frames: 0, lost: 0, keptShare: 0 });
});
