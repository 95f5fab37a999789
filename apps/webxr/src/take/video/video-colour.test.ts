import type { CameraPicture, CloudView, PictureUse } from '@farpoint/cloud-view';
import type { Batch, RobotClient, VideoDescription } from '@farpoint/operator';
import { signal } from '@preact/signals-core';
import { describe, expect, test } from 'vitest';
import { Switches } from '../../ground/switches.ts';
import { RobotVoice } from '../../testing/robot-voice.ts';
import type { VideoImage } from './readers/video-image.ts';
import { VideoColour } from './video-colour.ts';
import type { VideoFeed } from './video-feed.ts';

const DEPTH: VideoDescription = { name: 'Depth camera', mid: '2', codec: 'H264', ofSensor: 0 };
const FRONT: VideoDescription = { name: 'Front', mid: '1', codec: 'H264' };

/** A paint that keeps what it is told. */
class FakePaint {
  on = true;
  share = 0;
  use: PictureUse = 'matched';
  readonly expected: number[] = [];
  readonly taken: [CameraPicture, number][] = [];
  expect(instantUs: number): void {
    this.expected.push(instantUs);
  }
  take(picture: CameraPicture, instantUs: number): PictureUse {
    this.taken.push([picture, instantUs]);
    return this.use;
  }
}

class Bench extends RobotVoice {
  readonly paint = new FakePaint();
  readonly view = { paint: this.paint, isSurface: true, colouring: { mode: 'captured' } };
  readonly wanted = signal(true);
  readonly switches = new Switches();
  readonly hold = { exact: false };
  readonly feed: Pick<VideoFeed, 'onFrame'> = { onFrame: null };
  readonly colour: VideoColour;

  constructor({ synchronised = true, videos = [FRONT, DEPTH] } = {}) {
    super();
    this.colour = new VideoColour({
      ...{ client: this as unknown as RobotClient, feed: this.feed, hold: this.hold },
      settings: { synchronised },
      ...{ views: { switches: this.switches }, wanted: this.wanted },
      clouds: signal([this.view as unknown as CloudView]),
    });
    this.say('session', 1);
    this.switches.set(videos);
    this.say('videos', videos);
  }

  cloud(captureTimeUs: number): void {
    const batch = { sensor: 0, packets: 1, buffer: new ArrayBuffer(8), captureTimeUs: () => captureTimeUs };
    this.say('cloud', batch as unknown as Batch);
  }

  frame(video: number, captureMs: number, nowMs = 0): void {
    const image = {
      image: {} as ImageBitmap,
      width: 64,
      height: 48,
      rtpTimestamp: null,
      close: () => undefined,
    };
    this.feed.onFrame?.(video, image satisfies VideoImage, captureMs, nowMs);
  }

  state(nowMs = 0) {
    this.colour.update(nowMs);
    return this.colour.figures.state;
  }
}

describe('the video of the camera that the cloud comes from', () => {
  test('paints it, each picture with its capture instant as clouds carry it', () => {
    const bench = new Bench();
    bench.cloud(7);
    bench.frame(1, 5_000_000.25);
    bench.frame(0, 5_000_033);
    expect(bench.paint.expected).toEqual([7]);
    expect(bench.paint.taken).toEqual([
      [expect.objectContaining({ width: 64, height: 48 }), 5_000_000_250 % 2 ** 32],
    ]);
    expect(bench.colour.figures.pictures).toEqual({ matched: 1 });
  });

  test('paints nothing while it is not wanted, or not in step', () => {
    const bench = new Bench();
    bench.wanted.value = false;
    bench.cloud(7);
    bench.frame(1, 1000);
    expect([bench.paint.on, bench.paint.taken, bench.paint.expected]).toEqual([false, [], []]);
    bench.wanted.value = true;
    bench.frame(1, 1033);
    expect([bench.paint.on, bench.paint.taken.length]).toEqual([true, 1]);
    const apart = new Bench({ synchronised: false });
    apart.frame(1, 1000);
    expect([apart.paint.on, apart.paint.taken, apart.state()]).toEqual([false, [], 'not-in-step']);
  });

  test('makes clouds wait for their own pictures only while these come, and come later', () => {
    const bench = new Bench();
    const exactAt = (nowMs: number) => {
      bench.colour.update(nowMs);
      return bench.hold.exact;
    };
    expect(exactAt(0)).toBe(false);
    bench.paint.use = 'early';
    bench.frame(1, 1000, 10);
    expect(exactAt(20)).toBe(false);
    bench.paint.use = 'matched';
    bench.frame(1, 1033, 40);
    expect(exactAt(50)).toBe(true);
    expect(exactAt(1500)).toBe(false);
    bench.frame(1, 3000, 2000);
    bench.view.colouring.mode = 'height';
    expect(exactAt(2010)).toBe(false);
    bench.view.colouring.mode = 'captured';
    bench.wanted.value = false;
    expect(exactAt(2020)).toBe(false);
  });
});

test('it is said why the video does not paint', () => {
  expect(new Bench({ videos: [FRONT] }).state()).toBe('not-offered');
  const bench = new Bench();
  expect(bench.state()).toBe('no-picture');
  bench.frame(1, 967, 40);
  expect(bench.state(100)).toBe('late');
  bench.paint.use = 'between-frames';
  bench.frame(1, 1000, 50);
  expect(bench.state(100)).toBe('no-match');
  expect(bench.colour.figures.use).toBe('between-frames');
  bench.paint.share = 1;
  expect(bench.state(100)).toBe('painted');
  expect(bench.colour.figures.share).toBe(1);
  bench.paint.share = 0;
  expect(bench.state(2000)).toBe('no-picture');
  bench.view.colouring.mode = 'height';
  expect(bench.state(100)).toBe('other-colours');
  bench.view.isSurface = false;
  expect(bench.state(100)).toBe('no-surface');
  bench.switches.toggle(1);
  expect(bench.state(100)).toBe('not-watched');
  bench.wanted.value = false;
  expect(bench.state(100)).toBe('switched-off');
  bench.say('session', 2);
  expect(bench.state(100)).toBe('not-offered');
});
