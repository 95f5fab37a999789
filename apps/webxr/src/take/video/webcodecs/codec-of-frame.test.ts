import { expect, test } from 'vitest';
import { codecOfFrame } from './codec-of-frame.ts';

test.each([
  [{ mimeType: 'video/VP8' }, 'VP8'],
  [{ mimeType: 'video/H264', payloadType: 97 }, 'H264'],
  [{ mimeType: 'video/AV1' }, null],
  [{ mimeType: 7 }, null],
  [{}, null],
])('of %j', (metadata, codec) => {
  expect(codecOfFrame(metadata)).toBe(codec);
});
