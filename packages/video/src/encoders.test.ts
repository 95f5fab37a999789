import { describe, expect, it } from 'vitest';
import {
  type AvailableEncoder,
  chooseEncoder,
  chooseEncoders,
  ENCODER_PROPERTIES,
  encoderText,
  encoderThreads,
  neededElements,
  VIDEO_ENCODERS,
} from './encoders.ts';

const h264 = (name: string): AvailableEncoder => ({ name, codec: 'h264' });
const software: AvailableEncoder[] = [{ name: 'vp8enc', codec: 'vp8' }, h264('openh264enc'), h264('x264enc')];

describe('the choice', () => {
  it.each([
    ['auto', software, 'x264enc'],
    ['h264', software, 'x264enc'],
    ['vp8', software, 'vp8enc'],
    ['openh264enc', software, 'openh264enc'],
    ['auto', [...software, h264('vah264enc')], 'vah264enc'],
    ['auto', [...software, h264('vah264enc'), h264('nvh264enc')], 'nvh264enc'],
    ['h264', [...software, h264('nvv4l2h264enc')], 'nvv4l2h264enc'],
    ['x264enc', [...software, h264('vah264enc')], 'x264enc'],
    ['auto', [{ name: 'vp8enc', codec: 'vp8' }, h264('somebodysenc')], 'vp8enc'],
  ] as const)('of %s', (wanted, available, expected) => {
    const chosen = chooseEncoder(available, wanted);
    expect(chosen.ok && chosen.encoder.name).toBe(expected);
  });

  it.each([
    ['auto', software, ['x264enc', 'vp8enc']],
    ['auto', [...software, h264('vah264enc')], ['vah264enc', 'vp8enc']],
    ['auto', [h264('openh264enc')], ['openh264enc']],
    ['auto', [{ name: 'vp8enc', codec: 'vp8' }], ['vp8enc']],
    ['h264', software, ['x264enc']],
    ['openh264enc', software, ['openh264enc']],
  ] as const)('of one for each codec: %s', (wanted, available, expected) => {
    const chosen = chooseEncoders(available, wanted);
    expect(chosen.ok && chosen.encoders.map(({ name }) => name)).toEqual(expected);
  });

  it.each([
    ['vp8', [h264('x264enc')], /none of vp8enc is there \(there is x264enc\)/],
    ['auto', [], /none of nvh264enc, .* is there \(there is none\)/],
    ['x264', software, /x264 is not one of auto, h264, vp8, nvh264enc/],
  ] as const)('of %s fails where there is none', (wanted, available, sentence) => {
    const chosen = chooseEncoder(available, wanted);
    expect(chosen.ok ? null : chosen.failure).toMatchObject({
      reason: 'no-encoder',
      sentence: expect.stringMatching(sentence) as string,
      retried: false,
    });
  });
});

describe('an encoder', () => {
  it('in software has half of the cores, at most four', () => {
    expect([1, 2, 3, 4, 8, 64].map(encoderThreads)).toEqual([1, 1, 1, 2, 4, 4]);
  });

  it('of VP8 has at most two threads', () => {
    const text = (name: string, threads: number) =>
      encoderText(VIDEO_ENCODERS.find((each) => each.name === name)!, threads);
    expect([1, 2, 4].map((threads) => / threads=(\d)/.exec(text('vp8enc', threads))?.[1])).toEqual([
      ...['1', '2', '2'],
    ]);
    expect(text('x264enc', 4)).toContain(' threads=4');
  });

  // Of encoders that cannot be tried here, the text is compared with their documentation.
  it.each([
    [
      'nvh264enc',
      'nvh264enc name=farpoint-encoder preset=low-latency-hp zerolatency=true rc-mode=cbr gop-size=-1 bframes=0 rc-lookahead=0 ! video/x-h264,profile=constrained-baseline',
    ],
    [
      'nvv4l2h264enc',
      'nvvidconv ! video/x-raw(memory:NVMM),format=NV12 ! nvv4l2h264enc name=farpoint-encoder control-rate=1 preset-level=1 maxperf-enable=true profile=0 poc-type=2 insert-sps-pps=true iframeinterval=100000 idrinterval=100000',
    ],
    [
      'omxh264enc',
      'omxh264enc name=farpoint-encoder control-rate=2 preset-level=0 profile=1 insert-sps-pps=true iframeinterval=100000',
    ],
    [
      'vah264enc',
      'vah264enc name=farpoint-encoder rate-control=cbr target-usage=6 b-frames=0 ref-frames=1 key-int-max=1024 ! video/x-h264,profile=constrained-baseline',
    ],
    [
      'vaapih264enc',
      'vaapih264enc name=farpoint-encoder rate-control=cbr quality-level=6 max-bframes=0 refs=1 keyframe-period=100000 cpb-length=67 ! video/x-h264,profile=constrained-baseline',
    ],
  ])('%s is built as documented', (name, text) => {
    const encoder = VIDEO_ENCODERS.find((each) => each.name === name)!;
    expect(encoderText(encoder, 2)).toBe(
      `${text} ! h264parse config-interval=-1 ! video/x-h264,stream-format=byte-stream,alignment=au`,
    );
  });

  it.each(VIDEO_ENCODERS)('$name has a bit rate that can change, and its text is complete', (encoder) => {
    const following = encoder.following.find(({ name }) => /^(?:target-)?bitrate$/.test(name));
    expect([1, 0.001]).toContain(following?.perBitPerS);
    const text = encoderText(encoder, 3);
    expect(text).toContain(`${encoder.name} name=farpoint-encoder `);
    expect(text).not.toContain('THREADS');
    expect(neededElements(encoder)).toContain(encoder.name);
  });

  it('needs what is in front of it and behind it', () => {
    const needed = (name: string) => neededElements(VIDEO_ENCODERS.find((each) => each.name === name)!);
    expect(needed('vp8enc')).toEqual(['vp8enc']);
    expect(needed('x264enc')).toEqual(['x264enc', 'h264parse']);
    expect(needed('nvv4l2h264enc')).toEqual(['nvvidconv', 'nvv4l2h264enc', 'h264parse']);
  });

  it('takes further properties, and nothing else', () => {
    const vp8 = VIDEO_ENCODERS.find(({ name }) => name === 'vp8enc')!;
    expect(encoderText(vp8, 1, 'cpu-used=12')).toMatch(/ token-partitions=2 cpu-used=12 ! video\/x-vp8$/);
    for (const text of ['', 'cpu-used=12', 'speed-preset=veryfast threads=2'])
      expect(ENCODER_PROPERTIES.test(text), text).toBe(true);
    for (const text of ['! filesink', 'a=b ! filesink location=x', 'a="b"', 'a', 'a=b\nc=d', 'name=x!'])
      expect(ENCODER_PROPERTIES.test(text), text).toBe(false);
  });
});
