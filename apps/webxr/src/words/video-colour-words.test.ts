import type { PictureUse } from '@farpoint/cloud-view';
import { expect, test } from 'vitest';
import type { VideoColourState } from '../take/video/video-colour.ts';
import { videoColourWords } from './facts.ts';

const words = (state: VideoColourState, share = 0, use: PictureUse | null = null) =>
  videoColourWords({ state, share, use, pictures: {} });

test('what paints the surface is said, and why the video does not', () => {
  expect(words('painted', 1)).toBe('from the video');
  expect(words('painted', 0.614)).toBe('from the video for 61 %');
  expect(words('switched-off')).toBe('the points’ own');
  expect(words('no-picture')).toBe('the points’ own: no video comes');
  expect(words('not-watched')).toBe('the points’ own: the video is off');
  expect(words('no-match', 0, 'between-frames')).toBe('the points’ own: no picture was captured with them');
  expect(words('no-match', 0, 'other-shape')).toBe('the points’ own: the video’s shape is another');
});

test('nothing is said of a robot without such a video, and where colours are not the camera’s', () => {
  for (const state of ['not-offered', 'no-surface', 'other-colours'] as const)
    expect(words(state)).toBeNull();
});
