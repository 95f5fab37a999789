import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { ReadyPicture } from '../../sense/pictures/picture-messages.ts';
import { pictureAllowance } from '../../sense/pictures/picture-plan.ts';
import { PictureSender } from './picture-sender.ts';

const WIRE = 93;

class Channel {
  picturesBuffered = 0;
  /** Camera and number of each chunk. */
  readonly chunks: [number, number][] = [];
  bytes = 0;
  open = true;

  sendPicture(chunk: Uint8Array): number {
    if (!this.open) return 0;
    this.chunks.push([chunk[0] as number, chunk[1] as number]);
    this.bytes += chunk.length + WIRE;
    return chunk.length + WIRE;
  }
}

function picture(camera: number, pictureId: number, chunks: number): ReadyPicture {
  return {
    type: 'picture',
    header: { format: 'jpeg', camera, width: 8, height: 8, pictureId, captureTimeUs: 0 },
    chunks: Array.from({ length: chunks }, () => {
      const chunk = new Uint8Array(1160);
      chunk.set([camera, pictureId]);
      return chunk;
    }),
    ...{ capturedAtMs: 0, fileBytes: chunks * 1140, longestSide: 640, untouched: false, workMs: 1 },
  };
}

function setUp(cameras = [0, 1]) {
  const channel = new Channel();
  const sender = new PictureSender(channel);
  sender.watch(cameras);
  return { channel, sender };
}

describe('PictureSender', () => {
  it('sends no more than allowed, whatever is offered, and leaves clouds their share of a poor path', () => {
    for (const target of [0.4e6, 1e6, 2e6, 8e6]) {
      const { channel, sender } = setUp([0]);
      const allowed = pictureAllowance(target, 0.15);
      for (let ms = 0, id = 0; ms <= 20_000; ms += 25) {
        if (ms % 100 === 0) sender.offer(picture(0, id++ & 0xff, 8));
        sender.sendDue(ms, allowed);
      }
      const bitsPerSecond = (channel.bytes * 8) / 20;
      // One chunk and 100 ms of credit may be sent ahead.
      expect(bitsPerSecond).toBeLessThanOrEqual(allowed * 1.005 + (1293 * 8) / 20);
      expect(target - bitsPerSecond).toBeGreaterThan(target * 0.84);
      if (target <= 0.5e6) expect(channel.bytes).toBe(0);
      if (target >= 2e6) expect(sender.picturesSent).toBeGreaterThan(2);
    }
  });

  it('sends one whole picture after another, cameras in turn, the newest of each', () => {
    const { channel, sender } = setUp();
    sender.sendDue(0, 1e6);
    sender.offer(picture(0, 1, 2));
    sender.offer(picture(0, 2, 2));
    sender.offer(picture(1, 1, 2));
    for (let ms = 25; ms < 200; ms += 25) sender.sendDue(ms, 1e6);
    expect(channel.chunks).toEqual([
      [0, 2],
      [0, 2],
      [1, 1],
      [1, 1],
    ]);
    expect(sender.drops).toEqual({ superseded: 1, backlog: 0, overdue: 0 });
  });

  it('skips a picture while the channel is full, and pauses within one', () => {
    const { channel, sender } = setUp();
    sender.sendDue(0, 1e6);
    channel.picturesBuffered = 10_000;
    sender.offer(picture(0, 1, 4));
    sender.sendDue(100, 1e6);
    expect(sender.drops.backlog).toBe(1);
    channel.picturesBuffered = 0;
    sender.offer(picture(0, 2, 20));
    sender.sendDue(200, 1e6);
    const begun = channel.chunks.length;
    expect(begun).toBeGreaterThan(0);
    channel.picturesBuffered = 10_000;
    sender.sendDue(300, 1e6);
    expect(channel.chunks.length).toBe(begun);
    channel.picturesBuffered = 0;
    sender.sendDue(400, 1e6);
    expect(channel.chunks.length).toBeGreaterThan(begun);
  });

  it('keeps two chunks of 1,160 bytes queued, and waits while there are more', () => {
    const { channel, sender } = setUp([0]);
    sender.sendDue(0, 1e6);
    sender.offer(picture(0, 1, 10));
    const sendChunk = channel.sendPicture.bind(channel);
    channel.sendPicture = (chunk) => {
      channel.picturesBuffered += chunk.length;
      return sendChunk(chunk);
    };
    sender.sendDue(100, 1e6);
    expect(channel.chunks).toHaveLength(3);
    channel.picturesBuffered -= 1160;
    sender.sendDue(100, 1e6);
    expect(channel.chunks).toHaveLength(4);
  });

  it('gives up a picture that takes too long, and one that is refused', () => {
    const { channel, sender } = setUp();
    sender.sendDue(0, 50_000);
    sender.offer(picture(0, 1, 30));
    for (let ms = 25; ms <= 2000; ms += 25) sender.sendDue(ms, 50_000);
    expect(sender.drops.overdue).toBe(1);
    channel.open = false;
    sender.offer(picture(0, 2, 1));
    sender.sendDue(2100, 1e6);
    sender.sendDue(2200, 1e6);
    expect(sender.drops.backlog).toBe(1);
    expect(sender.picturesSent).toBe(0);
  });

  it('accepts only pictures of watched cameras', () => {
    const { channel, sender } = setUp([1]);
    sender.sendDue(0, 1e6);
    sender.offer(picture(0, 1, 1));
    sender.offer(picture(1, 1, 1));
    sender.watch([0]);
    sender.sendDue(100, 1e6);
    expect(channel.chunks).toEqual([]);
  });

  it('holds one picture per camera, and accounts for each', () => {
    const step = fc.tuple(fc.nat(2), fc.integer({ min: 1, max: 30 }), fc.nat(200));
    fc.assert(
      fc.property(
        fc.array(step, { maxLength: 80 }),
        fc.integer({ min: 10_000, max: 3_000_000 }),
        (steps, rate) => {
          const { sender } = setUp([0, 1, 2]);
          let ms = 0;
          for (const [camera, chunks, wait] of steps) {
            sender.offer(picture(camera, 0, chunks));
            ms += wait;
            sender.sendDue(ms, rate);
          }
          const { superseded, backlog, overdue } = sender.drops;
          const left = steps.length - sender.picturesSent - superseded - backlog - overdue;
          expect(left).toBeGreaterThanOrEqual(0);
          expect(left).toBeLessThanOrEqual(4);
        },
      ),
    );
  });
});
