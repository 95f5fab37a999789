/** The real program: it encodes, follows settings, drops when it is too slow, and comes back. */
import { afterEach, describe, expect, it } from 'vitest';
import { availableEncoders } from './available-encoders.ts';
import { chooseEncoder } from './encoders.ts';
import {
  barcodeTime,
  decodeLuma,
  encoderNamed,
  median,
  nowMs,
  VIDEO_SUITE,
  Watched,
} from './testing/helpers.ts';
import type { VideoProcessOptions } from './video-process.ts';
import type { RawFormat } from './wire.ts';

const QUICK_RETRY = { firstMs: 1, mostMs: 10 };
const SMALL = { kind: 'test', width: 320, height: 240, framesPerS: 30 } as const;
/** Noise needs all the bits there are. */
const NOISE = { format: 'i420', width: 320, height: 240, stride: 320 } as const;

let watched: Watched | null = null;
afterEach(() => watched?.process.close());

type Given = Partial<VideoProcessOptions> & Pick<VideoProcessOptions, 'source'>;

function watch(given: Given): Watched {
  watched = new Watched({
    encoder: encoderNamed('x264enc'),
    settings: { bitsPerS: 1_000_000 },
    retry: QUICK_RETRY,
    ...given,
  });
  return watched;
}

/** Gives a picture of noise, another one at each call, but the same ones at each run. */
function noise(): () => Uint8Array {
  let state = 1;
  return () =>
    Uint8Array.from({ length: (NOISE.stride * NOISE.height * 3) / 2 }, () => {
      state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0;
      return state >>> 24;
    });
}

/** Types of the NAL units in an access unit. */
function nalTypes(bytes: Uint8Array): number[] {
  const types: number[] = [];
  for (let i = 0; i + 3 < bytes.length; i++)
    if (bytes[i] === 0 && bytes[i + 1] === 0 && bytes[i + 2] === 1) types.push(bytes[i + 3]! & 31);
  return types;
}

const isVp8Key = (bytes: Uint8Array) => (bytes[0]! & 1) === 0;

describe(`the video process (${VIDEO_SUITE.note})`, { skip: VIDEO_SUITE.skip }, () => {
  it('finds the encoders of this machine', async () => {
    const { gstreamer, encoders } = await availableEncoders();
    expect(gstreamer).toMatch(/^1\.\d+\.\d+$/);
    expect(chooseEncoder(encoders, 'vp8')).toMatchObject({ ok: true, encoder: { name: 'vp8enc' } });
  });

  it.each(['x264enc', 'openh264enc', 'vp8enc'])(
    '%s encodes at the wanted rate, with capture times',
    async (name) => {
      const began = nowMs();
      const { playing, frames } = await encodes(name);
      expect(playing).toMatchObject({ encoder: name, width: 320, height: 240, sourceWidth: 320 });
      expect(frames[0]).toMatchObject({ key: true, width: 320, height: 240 });
      for (const { bytes, key } of frames) {
        if (playing?.codec === 'vp8') {
          expect(isVp8Key(bytes)).toBe(key);
        } else {
          expect([...bytes.subarray(0, 4)]).toEqual([0, 0, 0, 1]);
          const types = nalTypes(bytes).filter((type) => [1, 5, 7, 8].includes(type));
          expect([...new Set(types)]).toEqual(key ? [7, 8, 5] : [1]);
        }
      }
      const times = frames.map(({ captureMs }) => captureMs);
      expect(times[0]).toBeGreaterThan(began);
      const steps = times.slice(1).map((time, i) => time - times[i]!);
      // 15 of 30 frames/s. A slow machine gives fewer; a picture that comes late is made good by one that comes early.
      for (const step of steps) expect(step).toBeGreaterThan(30);
      expect(times.at(-1)! - times[0]!).toBeGreaterThan(17.5 * (1000 / 15));
      for (const { ageMs } of frames) expect(ageMs).toBeGreaterThan(0);
    },
  );

  async function encodes(name: string) {
    const video = watch({
      source: SMALL,
      encoder: encoderNamed(name),
      settings: { bitsPerS: 500_000, framesPerS: 15 },
    });
    const frames = await video.next(20);
    return { playing: video.playing, frames };
  }

  it.each(['x264enc', 'openh264enc', 'vp8enc'])(
    '%s gives a key frame on request, and else none',
    async (name) => {
      const video = watch({
        source: SMALL,
        encoder: encoderNamed(name),
        settings: { bitsPerS: 500_000, framesPerS: 5 },
      });
      const before = await video.next(6);
      expect(before.map(({ key }) => key)).toEqual([true, ...before.slice(1).map(() => false)]);
      // Just after a picture: the next one is 200 ms away.
      video.process.requestKeyFrame();
      const after = await video.next(4);
      expect(after.filter(({ key }) => key)).toHaveLength(1);
      expect(after.slice(0, 2).some(({ key }) => key)).toBe(true);
    },
  );

  it('changes size and rate while it runs', async () => {
    const video = watch({
      source: { ...SMALL, width: 640, height: 480 },
      settings: { bitsPerS: 1_000_000, framesPerS: 30 },
    });
    await video.next(3);
    expect(video.frames.at(-1)).toMatchObject({ width: 640, height: 480 });
    video.process.configure({ width: 320, framesPerS: 10 });
    await video.until(() => video.frames.at(-1)?.width === 320);
    expect(video.frames.at(-1)).toMatchObject({ key: true, height: 240 });
    const frames = await video.next(6);
    expect(frames.at(-1)!.captureMs - frames[0]!.captureMs).toBeGreaterThan(350);
    // It is never made larger than the source's, and back to that without a wish.
    video.process.configure({ width: undefined, framesPerS: undefined });
    await video.until(() => video.frames.at(-1)?.width === 640);
    expect(video.playing).toMatchObject({ width: 640, height: 480 });
    video.process.configure({ width: 8192, height: 101 });
    await video.until(() => video.frames.at(-1)?.width !== 640);
    expect(video.frames.at(-1)).toMatchObject({ width: 134, height: 100 });
    expect(video.failures).toEqual([]);
  });

  it.each(['x264enc', 'vp8enc'])('%s changes its bit rate while it runs', async (name) => {
    const video = watch({
      source: { kind: 'frames' },
      encoder: encoderNamed(name),
      settings: { bitsPerS: 6_000_000 },
    });
    const picture = noise();
    let captureNs = process.hrtime.bigint();
    /** Encodes pictures one by one, 30/s by their capture times: however slow the machine is, none is left out. */
    const encode = async (count: number) => {
      const frames = [];
      for (let i = 0; i < count; i++) {
        const next = video.next(1);
        captureNs += 33_333_333n;
        const { format, width, height, stride } = NOISE;
        const pushed = { captureNs, format, width, height, stride, bytes: picture() };
        expect(video.process.pushFrame(pushed)).toBe(true);
        frames.push(...(await next));
      }
      return frames;
    };
    await encode(15);
    for (const bitsPerS of [12_000_000, 6_000_000, 12_000_000]) {
      video.process.configure({ bitsPerS });
      // The encoder makes good what the rate before has left it with.
      const settling = await encode(15);
      const frames = await encode(30);
      expect([...settling, ...frames].some(({ key }) => key)).toBe(false);
      const bytes = frames.reduce((sum, frame) => sum + frame.bytes.length, 0);
      // Of the wanted rate. One that had not changed would be half or twice as much.
      const share = bytes / frames.length / (bitsPerS / 8 / 30);
      expect(share).toBeGreaterThan(0.7);
      expect(share).toBeLessThan(1.4);
    }
    expect(video.failures).toEqual([]);
  });

  // It fails on pushed noise (“Could not encode frame”), so its pictures come from a source that a busy machine thins out.
  it('openh264enc changes its bit rate while it runs', async () => {
    const video = watch({
      source: { ...SMALL, pattern: 'snow' },
      encoder: encoderNamed('openh264enc'),
      settings: { bitsPerS: 6_000_000 },
    });
    /** Each picture's share of the rate follows it, however many pictures a busy machine drops. */
    const size = () => median(video.frames.slice(-30).map(({ bytes }) => bytes.length));
    video.process.configure({ bitsPerS: 12_000_000 });
    await video.next(45);
    const high = size();
    const before = video.frames.length;
    video.process.configure({ bitsPerS: 6_000_000 });
    // How many pictures a change takes is the encoder's and the machine's business; one that never comes is an error.
    await video.until(() => size() < 0.8 * high);
    await video.next(30);
    const low = size();
    video.process.configure({ bitsPerS: 12_000_000 });
    await video.until(() => size() > 1.25 * low);
    expect(video.frames.slice(before).some(({ key }) => key)).toBe(false);
  });

  it.each([
    ['videotestsrc ! ! fakesink', 'parse', /syntax error/],
    ['videotestsrc ! nosuchelement', 'no-element', /nosuchelement/],
    ['videotestsrc nosuchproperty=3', 'parse', /nosuchproperty/],
    ['audiotestsrc is-live=true', 'parse', /audiotestsrc|link/],
    ['fakesink', 'parse', /./],
  ] as const)(
    'says what is wrong with the source %s, and does not try again',
    async (pipeline, reason, words) => {
      const video = watch({ source: { kind: 'gst', pipeline } });
      await video.until(() => video.failures.length > 0);
      expect(video.failures[0]).toMatchObject({ reason, retried: false });
      expect(video.failures[0]?.sentence).toMatch(words);
      expect(video.process.starts).toBe(1);
    },
  );

  it('says which encoder is missing', async () => {
    const video = watch({ source: SMALL, encoder: { ...encoderNamed('x264enc'), name: 'nosuchenc' } });
    await video.until(() => video.failures.length > 0);
    expect(video.failures[0]).toMatchObject({ reason: 'no-encoder', retried: false });
    expect(video.failures[0]?.sentence).toContain('nosuchenc');
  });

  it('says when it is not built', async () => {
    const video = watch({ source: SMALL, program: '/nonexistent/farpoint-video' });
    await video.until(() => video.failures.length > 0);
    expect(video.failures[0]).toMatchObject({ reason: 'not-built', retried: false });
    expect(video.failures[0]?.remedy).toContain('pnpm build:native video');
  });

  it.each([
    ['ends', { kind: 'gst', pipeline: 'videotestsrc is-live=true num-buffers=4' }, /ended/],
    [
      'is silent',
      { kind: 'gst', pipeline: 'videotestsrc is-live=true ! valve drop=true' },
      /no picture for 1 s/,
    ],
    ['is not there', { kind: 'v4l2', device: '/dev/nosuchcamera' }, /nosuchcamera/],
    ['cannot be reached', { kind: 'rtsp', url: 'rtsp://me:secret@127.0.0.1:9/x' }, /rtspsrc/],
  ] as const)('a source that %s is lost, and tried again', async (_, source, words) => {
    const video = watch({ source, silenceMs: 1000 });
    await video.until(() => video.process.starts > 2);
    for (const failure of video.failures) {
      expect(failure).toMatchObject({ reason: 'source-lost', retried: true });
      expect(failure.sentence).toMatch(words);
      expect(failure.sentence).not.toContain('secret');
    }
  });

  it('a file is played at its own pace', async () => {
    const video = watch({ source: { kind: 'gst', pipeline: 'videotestsrc num-buffers=200' } });
    const frames = await video.next(10);
    expect(frames.at(-1)!.captureMs - frames[0]!.captureMs).toBeGreaterThan(250);
    // Of this minute: the times are of the robot's clock.
    for (const { ageMs } of frames) expect(Math.abs(ageMs)).toBeLessThan(60_000);
  });

  it.each([
    'x264enc tune=zerolatency key-int-max=10 ! rtph264pay ! application/x-rtp,media=video ! decodebin',
    'jpegenc ! jpegdec',
    'vp8enc deadline=1 ! decodebin',
  ])('a coded source, as a camera sends it, is decoded: %s', async (rest) => {
    const video = watch({ source: { kind: 'gst', pipeline: `videotestsrc is-live=true ! ${rest}` } });
    const frames = await video.next(10);
    expect(frames[0]?.key).toBe(true);
    for (const { ageMs } of frames) expect(Math.abs(ageMs)).toBeLessThan(60_000);
    expect(video.failures).toEqual([]);
  });

  it.each([
    ['was killed', 'SIGKILL', 'process-lost', /./],
    ['hung', 'SIGSTOP', 'process-hung', /^the video process hung: it has said nothing for \d+ s$/],
  ] as const)('comes back after it %s, with a key frame first', async (_, signal, reason, words) => {
    const video = watch({ source: SMALL });
    await video.next(3);
    const lost = video.process.pid!;
    process.kill(lost, signal);
    await video.until(() => video.failures.length === 1);
    expect(video.failures[0]).toMatchObject({ reason, retried: true });
    expect(video.failures[0]?.sentence).toMatch(words);
    const [first] = await video.next(1);
    expect(first?.key).toBe(true);
    // It is gone, although one that hangs takes no friendly signal.
    expect(() => process.kill(lost, 0)).toThrow(/ESRCH/);
    expect(video.process.starts).toBe(2);
  });

  it('leaves no process', async () => {
    const video = watch({ source: SMALL });
    await video.next(1);
    const pid = video.process.pid!;
    await video.process.close();
    expect(() => process.kill(pid, 0)).toThrow(/ESRCH/);
    const { length } = video.frames;
    await video.process.close();
    expect(video.frames).toHaveLength(length);
    expect(video.failures).toEqual([]);
  });

  describe('with raw pictures', () => {
    const shapes: readonly [RawFormat, number, number, number, number, number][] = [
      // Format, size, stride; size as it is encoded.
      ['i420', 160, 120, 160, 160, 120],
      ['i420', 162, 122, 192, 162, 122],
      ['nv12', 162, 120, 162, 162, 120],
      ['rgb', 321, 241, 963, 322, 242],
      ['bgr', 320, 240, 1000, 320, 240],
      ['rgba', 64, 48, 256, 64, 48],
      ['bgra', 64, 48, 256, 64, 48],
      ['yuy2', 160, 120, 320, 160, 120],
      ['uyvy', 160, 120, 320, 160, 120],
      ['gray', 161, 121, 161, 162, 122],
    ];

    it('whose size and format change, each keeps its capture time', async () => {
      const video = watch({ source: { kind: 'frames' } });
      for (const [format, width, height, stride, encodedWidth, encodedHeight] of shapes) {
        for (let i = 0; i < 2; i++) {
          const captureNs = process.hrtime.bigint();
          const rows = format === 'i420' || format === 'nv12' ? height + Math.ceil(height / 2) : height;
          const next = video.next(1);
          expect(
            video.process.pushFrame({
              ...{ captureNs, format, width, height, stride },
              bytes: new Uint8Array(stride * rows).fill(99),
            }),
          ).toBe(true);
          const [frame] = await next;
          expect(frame).toMatchObject({ captureNs, width: encodedWidth, height: encodedHeight });
        }
      }
      expect(video.failures).toEqual([]);
    });

    it('refuses one with the wrong number of bytes, and drops those that come too fast', async () => {
      const video = watch({ source: { kind: 'frames' } });
      const frame = { format: 'rgba', width: 640, height: 480, stride: 2560 } as const;
      const bytes = new Uint8Array(2560 * 480);
      expect(() => video.process.pushFrame({ ...frame, captureNs: 1n, bytes: bytes.subarray(1) })).toThrow(
        RangeError,
      );
      const next = video.next(1);
      const captureNs = process.hrtime.bigint();
      expect(video.process.pushFrame({ ...frame, captureNs, bytes })).toBe(true);
      expect(video.process.pushFrame({ ...frame, captureNs: captureNs + 1n, bytes })).toBe(false);
      expect(video.process.notTaken).toBe(1);
      expect((await next)[0]?.captureNs).toBe(captureNs);
    });

    it('draws their capture times as barcodes', async () => {
      const [width, height] = [320, 240];
      const video = watch({
        source: { kind: 'frames' },
        settings: { bitsPerS: 2_000_000, barcode: 'monotonic' },
      });
      const shown = async (bytes: Uint8Array) => {
        const next = video.next(1);
        const captureNs = process.hrtime.bigint();
        video.process.pushFrame({ captureNs, format: 'gray', width, height, stride: width, bytes });
        await next;
      };
      for (let i = 0; i < 3; i++)
        await shown(Uint8Array.from({ length: width * height }, (_, at) => (at * 31 + i * 7) & 255));
      video.process.configure({ barcode: 'unix' });
      const beginMs = Date.now();
      await shown(new Uint8Array(width * height));
      const endMs = Date.now();
      const pictures = decodeLuma(Buffer.concat(video.frames.map((frame) => frame.bytes)), width, height);
      const times = pictures.map((luma) => barcodeTime(luma, width));
      expect(times.slice(0, 3)).toEqual(video.frames.slice(0, 3).map(({ captureNs }) => captureNs));
      const shownAtMs = Number(times[3]! / 1_000_000n);
      // Two clocks, each rounded.
      expect(shownAtMs).toBeGreaterThanOrEqual(beginMs - 2);
      expect(shownAtMs).toBeLessThanOrEqual(endMs + 2);
    });
  });
});
