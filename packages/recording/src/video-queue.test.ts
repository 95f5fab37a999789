import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type QueuedVideoFrame, VideoQueue } from './video-queue.ts';

const LIMITS = { underWay: 2, waiting: 4, waitingBytes: 1000 };

function setUp(limits = LIMITS) {
  const posted: QueuedVideoFrame[] = [];
  const asked: number[] = [];
  const queue = new VideoQueue<QueuedVideoFrame>(limits, (frame) => posted.push(frame));
  queue.onKeyFrameNeeded = (video) => asked.push(video);
  const push = (capturedAtMs: number, { key = false, video = 0, bytes = 10 } = {}) =>
    queue.push({ video, key, capturedAtMs, bytes: new Uint8Array(bytes) });
  return { queue, posted, asked, push };
}

describe('VideoQueue', () => {
  it('begins with a key frame, and asks for one', () => {
    const { queue, posted, asked, push } = setUp();
    for (const ms of [0, 33, 66]) expect(push(ms)).toBe(false);
    expect(asked).toEqual([0]);
    push(1100);
    expect(asked).toEqual([0, 0]);
    expect(push(1133, { key: true })).toBe(true);
    expect(push(1166)).toBe(true);
    expect(posted.map(({ capturedAtMs }) => capturedAtMs)).toEqual([1133, 1166]);
    expect(queue.dropped).toBe(4);
  });

  it('asks for a key frame now and then, so that one can jump into the video', () => {
    const { queue, asked, push } = setUp();
    push(0, { key: true });
    for (let ms = 100; ms <= 4500; ms += 100) {
      push(ms);
      queue.done();
    }
    expect(asked).toEqual([0]);
    push(4600, { key: true });
    push(8000);
    expect(asked).toEqual([0]);
    expect(queue.dropped).toBe(0);
  });

  it('drops the oldest frame with all that build on it, and nothing of other videos', () => {
    const { queue, posted, push } = setUp();
    push(0, { key: true });
    push(1);
    for (const ms of [2, 3]) push(ms);
    push(4, { video: 1, key: true });
    push(5, { key: true });
    push(6);
    expect(queue.dropped).toBe(2);
    for (let i = 0; i < 10; i++) queue.done();
    expect(posted.map(({ capturedAtMs }) => capturedAtMs)).toEqual([0, 1, 4, 5, 6]);
  });

  it('goes on with a key frame after a loss that none in the queue repairs', () => {
    const { queue, posted, asked, push } = setUp();
    push(0, { key: true });
    for (let ms = 1; ms <= 6; ms++) push(ms);
    expect(queue.dropped).toBe(5);
    expect(push(7)).toBe(false);
    expect(asked).toEqual([0]);
    queue.done();
    push(8, { key: true });
    expect(posted.at(-1)?.capturedAtMs).toBe(8);
  });

  it('limits bytes, too', () => {
    const { queue, push } = setUp();
    push(0, { key: true });
    push(1, { key: true });
    push(2, { key: true, bytes: 600 });
    push(3, { key: true, bytes: 600 });
    expect(queue.dropped).toBe(1);
  });

  it('passes on only what can be decoded, whatever comes and however slow the receiver is', () => {
    const step = fc.oneof(
      fc.record({ video: fc.nat(1), key: fc.boolean(), bytes: fc.integer({ min: 1, max: 400 }) }),
      fc.constant('done' as const),
    );
    fc.assert(
      fc.property(fc.array(step, { maxLength: 80 }), (steps) => {
        const numbers = [0, 0];
        const posted: (QueuedVideoFrame & { number: number })[] = [];
        const queue = new VideoQueue<QueuedVideoFrame & { number: number }>(LIMITS, (frame) =>
          posted.push(frame),
        );
        let pushed = 0;
        let underWay = 0;
        for (const [i, each] of steps.entries()) {
          if (each === 'done') {
            if (underWay < posted.length) {
              underWay++;
              queue.done();
            }
            continue;
          }
          pushed++;
          const number = numbers[each.video]!++;
          queue.push({ ...each, number, capturedAtMs: i, bytes: new Uint8Array(each.bytes) });
        }
        queue.drain();
        for (const video of [0, 1]) {
          const own = posted.filter((frame) => frame.video === video);
          own.forEach((frame, i) => {
            const before = own[i - 1]?.number;
            if (!frame.key) expect(before).toBe(frame.number - 1);
          });
        }
        expect(posted.length + queue.dropped).toBe(pushed);
      }),
    );
  });
});
