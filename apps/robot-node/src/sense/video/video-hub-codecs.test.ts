/** Cameras that can be encoded with several codecs. */
import type { VideoCodec } from '@farpoint/protocol';
import { beforeEach, describe, expect, it } from 'vitest';
import { FakeEncoder, FakeOperator } from './testing/fake-encoder.ts';
import { VideoHub } from './video-hub.ts';
import type { VideoFormat } from './video-plan.ts';

const most: VideoFormat = { width: 640, height: 480, framesPerSecond: 30, bitsPerSecond: 1e6 };
/** Lets what waits for a closed encoder go on. */
const settled = () => new Promise((resolve) => setImmediate(resolve));

describe('a camera with several codecs', () => {
  let encoders: FakeEncoder[];
  let operators: FakeOperator[];
  let driver: string | null;
  let taken: VideoCodec[];
  let told: VideoCodec[];
  let hub: VideoHub;
  let recording: boolean;
  let isSlow: boolean;
  let nowMs: number;

  beforeEach(() => {
    encoders = [];
    operators = [];
    driver = null;
    taken = [];
    told = [];
    recording = isSlow = false;
    nowMs = 0;
    hub = new VideoHub({
      cameras: [
        {
          ...{ name: 'Front', codecs: ['H264', 'VP8'], most },
          open: (codec, format, events) => {
            const encoder = new FakeEncoder(codec, format, events, isSlow);
            encoders.push(encoder);
            return encoder;
          },
        },
      ],
      targets: () => operators,
      taker: { wants: () => recording, take: (_video, _picture, codec) => void taken.push(codec) },
      driver: () => driver,
      onStateChanged: () => told.push(hub.descriptions[0]!.codec),
      onFrame: () => undefined,
      log: { info: () => undefined, warn: () => undefined },
    });
  });

  /** Plans as often as the robot does, for so long. */
  async function pass(ms: number): Promise<void> {
    for (const endMs = nowMs + ms; nowMs < endMs; ) {
      nowMs += 100;
      hub.update(nowMs);
      await settled();
    }
  }

  /** Somebody watches who takes another codec, and the encoder takes long to close. */
  async function change(): Promise<void> {
    isSlow = true;
    operators = [new FakeOperator('a', 5e6)];
    await pass(500);
    operators = [new FakeOperator('b', 5e6, ['VP8'])];
    await pass(500);
  }

  const opened = () => encoders.map(({ codec, closed }) => (closed ? `(${codec})` : codec));

  it('has the preferred one, whoever takes all', async () => {
    operators = [new FakeOperator('a', 5e6)];
    await pass(500);
    expect(opened()).toEqual(['H264']);
    expect(told).toEqual([]);
    expect(hub.descriptions).toEqual([{ name: 'Front', codec: 'H264' }]);
  });

  it('is encoded anew for one who takes another, and back when the preferred one serves everyone', async () => {
    const both = new FakeOperator('a', 5e6);
    operators = [both];
    await pass(500);
    encoders[0]!.picture(10);
    operators = [both, new FakeOperator('b', 5e6, ['VP8'])];
    await pass(500);
    expect(opened()).toEqual(['(H264)', 'VP8']);
    expect(told).toEqual(['VP8']);
    // What the first still had is not sent: its frames would be in the wrong codec.
    encoders[0]!.picture(20);
    // Begins with what is older than the newest frame: nothing can be decoded without that.
    encoders[1]!.picture(5);
    encoders[1]!.picture(25, false);
    expect(encoders[1]!.keyFrames).toBe(1);
    encoders[1]!.picture(30);
    expect(both.frames.map(({ codec, capturedAtMs }) => [codec, capturedAtMs])).toEqual([
      ['H264', 10],
      ['VP8', 30],
    ]);
    expect(taken).toEqual(['H264', 'VP8']);
    operators = [both];
    await pass(4500);
    expect(opened()).toEqual(['(H264)', 'VP8']);
    await pass(1000);
    expect(opened()).toEqual(['(H264)', '(VP8)', 'H264']);
    expect(told).toEqual(['VP8', 'H264']);
  });

  it('is opened with what the first who watches takes', async () => {
    operators = [new FakeOperator('a', 5e6, ['VP8'])];
    await pass(500);
    expect(opened()).toEqual(['VP8']);
    operators = [];
    await pass(4000);
    expect(opened()).toEqual(['(VP8)']);
    expect(hub.descriptions[0]?.codec).toBe('H264');
  });

  it('waits until its encoder is gone, because two cannot have one camera', async () => {
    await change();
    await pass(500);
    expect(opened()).toEqual(['(H264)']);
    // What is wanted meanwhile counts.
    operators[0]!.bitsPerSecond = 500_000;
    await pass(500);
    encoders[0]!.gone();
    await settled();
    expect(opened()).toEqual(['(H264)', 'VP8']);
    expect(encoders[1]!.formats[0]?.bitsPerSecond).toBe(500_000);
  });

  it('is not opened again if nobody wants it by the time its encoder is gone', async () => {
    await change();
    operators = [];
    await pass(4000);
    encoders[0]!.gone();
    await settled();
    expect(opened()).toEqual(['(H264)']);
    expect(hub.streams[0]!.format).toBeNull();
  });

  it('resolves its closing only when the camera is free', async () => {
    await change();
    let isClosed = false;
    void hub.close().then(() => {
      isClosed = true;
    });
    await settled();
    expect(isClosed).toBe(false);
    encoders[0]!.gone();
    await settled();
    expect([isClosed, opened()]).toEqual([true, ['(H264)']]);
  });

  it('follows the paths of those only who decode it, and claims nothing of the others’', async () => {
    const h264 = new FakeOperator('a', 800_000, ['H264']);
    const vp8 = new FakeOperator('b', 0, ['VP8']);
    driver = 'a';
    operators = [h264, vp8];
    await pass(500);
    expect(encoders[0]!.formats.at(-1)?.bitsPerSecond).toBe(800_000);
    expect(hub.mostBitsPerSecond(0, h264.codecs)).toBe(1e6);
    expect(hub.mostBitsPerSecond(0, vp8.codecs)).toBe(0);
    driver = 'b';
    vp8.bitsPerSecond = 300_000;
    await pass(500);
    expect(opened()).toEqual(['(H264)', 'VP8']);
    expect(encoders[1]!.formats.at(-1)?.bitsPerSecond).toBe(300_000);
  });

  it('is recorded with the codec that those who watch need', async () => {
    recording = true;
    await pass(500);
    encoders[0]!.picture(10);
    operators = [new FakeOperator('b', 5e6, ['VP8'])];
    await pass(500);
    encoders[1]!.picture(20);
    operators = [];
    await pass(6000);
    encoders[2]!.picture(30);
    expect(taken).toEqual(['H264', 'VP8', 'H264']);
  });
});
