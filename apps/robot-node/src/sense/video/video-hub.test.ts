import { VIDEO_CODECS, type VideoCodec } from '@farpoint/protocol';
import { beforeEach, describe, expect, it } from 'vitest';
import { FakeEncoder, FakeOperator } from './testing/fake-encoder.ts';
import type { VideoEncoderEvents } from './video-encoder.ts';
import type { VideoFrame } from './video-frame.ts';
import { VideoHub } from './video-hub.ts';
import type { EncodedFormat, VideoFormat } from './video-plan.ts';

const all = new Set(VIDEO_CODECS);
const most: VideoFormat = { width: 640, height: 480, framesPerSecond: 30, bitsPerSecond: 1e6 };

describe('VideoHub', () => {
  let encoders: FakeEncoder[];
  let operators: FakeOperator[];
  let driver: string | null;
  let changes: number;
  let hub: VideoHub;
  let recording: boolean;
  let taken: [video: number, capturedAtMs: number][];

  beforeEach(() => {
    encoders = [];
    operators = [];
    driver = null;
    changes = 0;
    recording = false;
    taken = [];
    const open = (codec: VideoCodec, format: EncodedFormat, events: VideoEncoderEvents) => {
      const encoder = new FakeEncoder(codec, format, events);
      encoders.push(encoder);
      return encoder;
    };
    hub = new VideoHub({
      cameras: [
        { name: 'Front', codecs: ['VP8'], most, open },
        { name: 'Rear', codecs: ['VP8'], most, open },
      ],
      targets: () => operators,
      taker: {
        wants: () => recording,
        take: (video, { capturedAtMs }) => void taken.push([video, capturedAtMs]),
      },
      driver: () => driver,
      onStateChanged: () => changes++,
      onFrame: () => undefined,
      log: { info: () => undefined, warn: () => undefined },
    });
  });

  /** Somebody watches the first camera, over a path that leaves it this rate. */
  function watch(bitsPerSecond: number): FakeOperator {
    const operator = new FakeOperator('a', bitsPerSecond);
    operators = [operator];
    hub.update(0);
    return operator;
  }

  it('opens a camera while somebody watches, and no other', async () => {
    hub.update(0);
    expect(encoders).toHaveLength(0);
    operators = [new FakeOperator('a', 5e6)];
    hub.update(1000);
    expect(encoders).toHaveLength(1);
    expect(encoders[0]!.formats).toEqual([{ ...most, barcode: false }]);
    operators = [];
    hub.update(2000);
    expect(encoders[0]!.closed).toBe(false);
    hub.update(5000);
    expect(encoders[0]!.closed).toBe(true);
    await new Promise((resolve) => setImmediate(resolve));
    operators = [new FakeOperator('b', 5e6)];
    hub.update(6000);
    expect(encoders).toHaveLength(2);
  });

  it('asks an encoder that gives too little for more, and begins anew when the rate changes', () => {
    const operator = watch(800_000);
    const encoder = encoders[0]!;
    // 2000 bytes of 3333.
    for (let i = 1; i <= 30; i++) encoder.picture(i * 33);
    expect(encoder.formats.map(({ bitsPerSecond }) => bitsPerSecond)).toEqual([800_000, 1_040_000]);
    operator.bitsPerSecond = 400_000;
    hub.update(1000);
    expect(encoder.formats.at(-1)?.bitsPerSecond).toBe(520_000);
    for (let i = 31; i <= 60; i++) encoder.picture(i * 33);
    expect(encoder.formats.at(-1)?.bitsPerSecond).toBeLessThan(450_000);
    expect(hub.streams[0]!.format?.bitsPerSecond).toBe(400_000);
  });

  it('claims nothing of the link for a camera without pictures', () => {
    watch(800_000);
    expect(hub.mostBitsPerSecond(0, all)).toBe(1e6);
    encoders[0]!.events.onFault('unplugged');
    expect(hub.mostBitsPerSecond(0, all)).toBe(0);
    encoders[0]!.events.onFault(null);
    expect(hub.mostBitsPerSecond(0, all)).toBe(1e6);
    expect(hub.mostBitsPerSecond(7, all)).toBe(0);
  });

  it('encodes once for everyone, at the rate of the narrowest path', () => {
    operators = [new FakeOperator('a', 800_000), new FakeOperator('b', 500_000)];
    hub.update(0);
    encoders[0]!.picture(10);
    expect(encoders).toHaveLength(1);
    expect(encoders[0]!.formats.at(-1)?.bitsPerSecond).toBe(500_000);
    expect(operators.map(({ frames }) => frames.length)).toEqual([1, 1]);
    expect(operators[0]!.frames[0]).toBe(operators[1]!.frames[0]);
  });

  it('follows the driver’s path, whoever watches', () => {
    operators = [new FakeOperator('a', 800_000), new FakeOperator('b', 200_000)];
    driver = 'a';
    hub.update(0);
    expect(encoders[0]!.formats.at(-1)?.bitsPerSecond).toBe(800_000);
    // A driver who does not watch the camera has no say.
    operators[0]!.wantedVideos = new Set();
    hub.update(1000);
    expect(encoders[0]!.formats.at(-1)?.bitsPerSecond).toBe(200_000);
  });

  it('tells the encoder only of changes that matter', () => {
    const operator = watch(800_000);
    operator.bitsPerSecond = 810_000;
    hub.update(1000);
    expect(encoders[0]!.formats).toHaveLength(1);
    operator.bitsPerSecond = 700_000;
    hub.update(2000);
    expect(encoders[0]!.formats.map(({ bitsPerSecond }) => bitsPerSecond)).toEqual([800_000, 700_000]);
  });

  it('draws the capture time while anybody wants it', () => {
    operators = [new FakeOperator('a', 800_000), new FakeOperator('b', 800_000)];
    driver = 'a';
    hub.update(0);
    operators[1]!.wantsBarcode = true;
    hub.update(1000);
    operators[1]!.wantedVideos = new Set();
    hub.update(2000);
    expect(encoders[0]!.formats.map(({ barcode }) => barcode)).toEqual([false, true, false]);
  });

  it('sends nothing while the path carries no video, and a key frame after that', () => {
    const operator = watch(800_000);
    encoders[0]!.picture(10);
    operator.bitsPerSecond = 10_000;
    hub.update(1000);
    encoders[0]!.picture(20, false);
    expect(operator.frames).toHaveLength(1);
    operator.bitsPerSecond = 800_000;
    hub.update(2000);
    expect(encoders[0]!.keyFrames).toBe(1);
    encoders[0]!.picture(30);
    expect(operator.frames.map(({ capturedAtMs }) => capturedAtMs)).toEqual([10, 30]);
  });

  it('says why there are no pictures, and that they are back, once each', () => {
    watch(800_000);
    const { events } = encoders[0]!;
    events.onFault(null);
    expect(changes).toBe(0);
    for (let i = 0; i < 2; i++) events.onFault('the camera is unplugged', 'source-lost');
    expect([...hub.streams[0]!.failures.entries()]).toEqual([['source-lost', 2]]);
    expect(changes).toBe(1);
    expect(hub.descriptions).toEqual([
      { name: 'Front', codec: 'VP8', fault: 'the camera is unplugged' },
      { name: 'Rear', codec: 'VP8' },
    ]);
    events.onFault(null);
    expect(changes).toBe(2);
    expect(hub.descriptions[0]).toEqual({ name: 'Front', codec: 'VP8' });
  });

  it('drops what is no picture, and pictures that are not newer', () => {
    watch(800_000);
    const [encoder] = encoders as [FakeEncoder];
    encoder.events.onPicture({ bytes: new Uint8Array(0), key: true, capturedAtMs: 1, width: 1, height: 1 });
    for (const capturedAtMs of [10, 10, 5, 11]) encoder.picture(capturedAtMs);
    expect(operators[0]!.frames.map(({ capturedAtMs }) => capturedAtMs)).toEqual([10, 11]);
    expect(hub.streams[0]!.counters).toMatchObject({ frames: 2, keyFrames: 2, bytes: 4000, badPictures: 1 });
  });

  it('ignores what a closed encoder still sends, and adds up what encoders skipped', async () => {
    watch(800_000);
    encoders[0]!.dropped = 7;
    await hub.close();
    expect(encoders[0]!.closed).toBe(true);
    encoders[0]!.picture(10);
    encoders[0]!.events.onFault('gone');
    expect(operators[0]!.frames).toHaveLength(0);
    expect(hub.streams[0]!.dropped).toBe(7);
    expect(changes).toBe(0);
  });

  it('makes packets that fit a path, with the capture time as their timestamp', () => {
    watch(800_000);
    encoders[0]!.picture(1000.5);
    const [frame] = operators[0]!.frames as [VideoFrame];
    expect(frame.packets).toBe(2);
    expect(frame.rtpTimestamp).toBe(90_045);
    const sizes = [0, 1].map((i) => frame.payload(i).length);
    expect(Math.max(...sizes)).toBeLessThanOrEqual(1180);
    expect(frame.bytes).toBe(sizes[0]! + sizes[1]! + 2 * 76);
  });

  describe('with a recording', () => {
    beforeEach(() => {
      recording = true;
    });

    it('encodes cameras that nobody watches, at their full rate', () => {
      hub.update(0);
      expect(encoders.map(({ formats }) => formats)).toEqual([
        [{ ...most, barcode: false }],
        [{ ...most, barcode: false }],
      ]);
      encoders[1]!.picture(10);
      expect(taken).toEqual([[1, 10]]);
      recording = false;
      hub.update(5000);
      expect(encoders.every(({ closed }) => closed)).toBe(true);
    });

    it.each([true, false])('gets what operators get, encoded once: of every camera %s', (every) => {
      recording = every;
      watch(500_000);
      expect(encoders).toHaveLength(every ? 2 : 1);
      encoders[0]!.picture(10);
      expect(encoders[0]!.formats.at(-1)?.bitsPerSecond).toBe(500_000);
      expect(operators[0]!.frames.map(({ capturedAtMs }) => capturedAtMs)).toEqual([10]);
      expect(taken).toEqual([[0, 10]]);
    });

    it('goes on at the full rate while the operator’s path carries no video', () => {
      const operator = watch(10_000);
      encoders[0]!.picture(10);
      expect(encoders[0]!.formats).toEqual([{ ...most, barcode: false }]);
      expect(operator.frames).toHaveLength(0);
      expect(taken).toEqual([[0, 10]]);
      operator.bitsPerSecond = 900_000;
      hub.update(1000);
      expect(encoders[0]!.keyFrames).toBe(1);
      encoders[0]!.picture(20);
      expect(operator.frames).toHaveLength(1);
    });
  });
});
