import { expect, it } from 'vitest';
import { judgeVideo } from './check-video.ts';

const vp8 = { name: 'vp8enc', codec: 'vp8', encodeMs: 6.12 } as const;
const front = { name: 'Front', encoder: 'auto' };

it('lists what encoders cost', () => {
  expect(judgeVideo([vp8], [])).toEqual([
    { verdict: 'ok', detail: 'vp8enc (VP8, CPU): 6.1 ms for a picture of 1024 × 768' },
  ]);
  expect(judgeVideo([{ ...vp8, encodeMs: 20 }], [])[0]).toMatchObject({ verdict: 'warn' });
});

it('warns of an encoder that is there and does not work', () => {
  const [result] = judgeVideo([{ name: 'vah264enc', codec: 'h264', encodeMs: null }], []);
  expect(result).toMatchObject({ verdict: 'warn', detail: 'vah264enc (H.264, VA-API) gives no pictures' });
});

it('says which encoder each camera gets, and which camera gets none', () => {
  const results = judgeVideo([vp8], [front, { name: 'Rear', encoder: 'x264enc' }]);
  expect(results.slice(1)).toMatchObject([
    { verdict: 'ok', detail: 'Front is encoded by vp8enc' },
    { verdict: 'fail', detail: expect.stringContaining('Rear: the encoder is not installed') as string },
  ]);
});

it('says that video is not built, which matters only with cameras', () => {
  const failure = {
    reason: 'not-built',
    sentence: 'cannot be started',
    remedy: 'build',
    retried: false,
  } as const;
  expect(judgeVideo(failure, [])).toMatchObject([{ verdict: 'ok' }]);
  expect(judgeVideo(failure, [front])).toEqual([
    { verdict: 'fail', detail: 'no video: cannot be started', remedy: 'build' },
  ]);
});
