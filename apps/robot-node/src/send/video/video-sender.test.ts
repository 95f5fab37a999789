import type { VideoCodec } from '@farpoint/protocol';
import { beforeEach, describe, expect, it } from 'vitest';
import type { VideoFrame } from '../../sense/video/video-frame.ts';
import { VideoSender } from './video-sender.ts';

const frame = (video: number, key = false, codec: VideoCodec = 'H264') =>
  ({ video, key, codec }) as VideoFrame;

describe('VideoSender', () => {
  let queued: VideoFrame[];
  let asked: number[];
  let sender: VideoSender;

  beforeEach(() => {
    queued = [];
    asked = [];
    sender = new VideoSender(
      new Map<number, Set<VideoCodec>>([
        [0, new Set(['H264', 'VP8'])],
        [1, new Set(['H264'])],
      ]),
      (each) => queued.push(each),
      (video) => asked.push(video),
    );
  });

  it('sends nothing before the operator asks for it', () => {
    sender.offer(frame(0, true));
    expect(queued).toEqual([]);
    expect(asked).toEqual([]);
  });

  it('begins with a key frame, and asks for one', () => {
    sender.want([0]);
    expect(asked).toEqual([0]);
    const [key, next] = [frame(0, true), frame(0)];
    for (const each of [frame(0), key, next, frame(1, true)]) sender.offer(each);
    expect(queued).toEqual([key, next]);
    expect(sender.drops).toEqual({ 'other-codec': 0, 'no-key-frame': 1, overdue: 0 });
  });

  it('leaves out what the operator does not decode, and goes on with a key frame that it does', () => {
    sender.want([0, 1]);
    const first = [frame(0, true), frame(1, true)];
    const other = [
      frame(0, true, 'VP8'),
      frame(1, true, 'VP8'),
      frame(0, false, 'VP8'),
      frame(1, false, 'VP8'),
    ];
    const back = [frame(1), frame(1, true), frame(0)];
    for (const each of [...first, ...other, ...back]) sender.offer(each);
    expect(queued).toEqual([...first, other[0], other[2], back[1]]);
    expect(sender.drops).toEqual({ 'other-codec': 2, 'no-key-frame': 2, overdue: 0 });
  });

  it('ignores a video that the operator refused or that does not exist', () => {
    sender.want([2, 7]);
    expect(asked).toEqual([]);
    sender.offer(frame(2, true));
    expect(queued).toEqual([]);
  });

  it('continues with a key frame after a dropped frame', () => {
    sender.want([0, 1]);
    for (const video of [0, 1]) sender.offer(frame(video, true));
    sender.onDropped(0);
    expect(asked).toEqual([0, 1, 0]);
    queued = [];
    const key = frame(0, true);
    for (const each of [frame(0), key]) sender.offer(each);
    expect(queued).toEqual([key]);
  });

  it('asks for a key frame when the operator has lost the picture, but goes on meanwhile', () => {
    sender.want([0]);
    sender.offer(frame(0, true));
    sender.onPictureLoss(0);
    sender.onPictureLoss(1);
    expect(asked).toEqual([0, 0]);
    sender.offer(frame(0));
    expect(queued).toHaveLength(2);
  });

  it('needs key frames again after a stop, and after a video was switched off and on', () => {
    sender.want([0]);
    sender.offer(frame(0, true));
    sender.clear();
    sender.offer(frame(0));
    sender.offer(frame(0, true));
    sender.want([]);
    sender.want([0]);
    sender.offer(frame(0));
    expect(queued).toHaveLength(2);
    expect(asked).toEqual([0, 0, 0]);
  });
});
