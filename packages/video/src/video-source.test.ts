import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { quoted, silenceMs, sourceText, type VideoSourceOptions, videoSourceSchema } from './video-source.ts';

/** Any code points. `fc.string` with the unit `binary` takes seconds to begin. */
const anyText = fc
  .array(fc.nat(0x10ffff), { maxLength: 10 })
  .map((codes) => String.fromCodePoint(...codes).toWellFormed());

const text = (source: VideoSourceOptions) => sourceText(videoSourceSchema.parse(source));
const accepted = (source: unknown) => videoSourceSchema.safeParse(source).success;

describe('a source’s text', () => {
  it.each<[VideoSourceOptions, string]>([
    [{ kind: 'test' }, 'videotestsrc pattern=pinwheel ! video/x-raw,width=1024,height=768,framerate=30/1'],
    [
      { kind: 'test', pattern: 'snow', width: 320, height: 240, framesPerS: 29.97 },
      'videotestsrc pattern=snow ! video/x-raw,width=320,height=240,framerate=29970/1000',
    ],
    [{ kind: 'v4l2', device: '/dev/video0' }, 'v4l2src device="/dev/video0" ! video/x-raw'],
    [
      {
        kind: 'v4l2',
        device: '/dev/v4l/by-id/usb-046d_C920-index0',
        width: 1280,
        height: 720,
        framesPerS: 30,
      },
      'v4l2src device="/dev/v4l/by-id/usb-046d_C920-index0" ! video/x-raw,width=1280,height=720,framerate=30/1',
    ],
    [
      { kind: 'v4l2', device: '/dev/video2', format: 'jpeg', width: 1920, height: 1080 },
      'v4l2src device="/dev/video2" ! image/jpeg,width=1920,height=1080 ! jpegdec',
    ],
    [
      { kind: 'rtsp', url: 'rtsp://user:p%40ss@10.0.0.5:554/stream?channel=1' },
      'rtspsrc location="rtsp://user:p%40ss@10.0.0.5:554/stream?channel=1" latency=50 drop-on-latency=true protocols=tcp ! application/x-rtp,media=video ! decodebin',
    ],
    [{ kind: 'gst', pipeline: 'filesrc location=a.y4m ! decodebin' }, 'filesrc location=a.y4m ! decodebin'],
    [
      { kind: 'frames' },
      'appsrc name=farpoint-frames is-live=true format=time max-buffers=1 leaky-type=downstream',
    ],
  ])('of %j', (source, expected) => {
    expect(text(source)).toBe(expected);
  });

  it('waits longer for a camera in a network, and for ever for pictures that are pushed', () => {
    expect(silenceMs({ kind: 'v4l2', device: '/dev/video0', format: 'raw' })).toBe(5000);
    expect(silenceMs({ kind: 'gst', pipeline: 'x' })).toBe(15_000);
    expect(silenceMs({ kind: 'frames' })).toBe(0);
  });
});

describe('nothing can be added to the pipeline', () => {
  it.each([
    '/dev/video0 ! filesink location=/etc/passwd',
    '/dev/video0" ! fakesink name="',
    '/dev/../etc/passwd',
    '/etc/passwd',
    'video0',
    '/dev/',
    '/dev/video0\n',
    '/dev/video0\0',
  ])('by the device %j', (device) => {
    expect(accepted({ kind: 'v4l2', device })).toBe(false);
  });

  it.each([
    'http://camera/stream',
    'rtsp://',
    'rtsp://camera/a b',
    'rtsp://camera/" ! filesink location="/tmp/x',
    'rtsp://camera/\\',
    'rtsp://camera/\n',
    'file:///etc/passwd',
  ])('by the address %j', (url) => {
    expect(accepted({ kind: 'rtsp', url })).toBe(false);
  });

  it('by any device or address: what is accepted stays within its quotes', () => {
    fc.assert(
      fc.property(fc.string(), anyText, (a, b) => {
        for (const part of [a, b]) {
          const device = videoSourceSchema.safeParse({ kind: 'v4l2', device: `/dev/${part}` });
          if (device.success)
            expect(sourceText(device.data)).toMatch(/^v4l2src device="[^"\\\s]*" ! video\/x-raw$/);
          const rtsp = videoSourceSchema.safeParse({ kind: 'rtsp', url: `rtsp://c/${part}` });
          if (rtsp.success) expect(sourceText(rtsp.data)).toMatch(/^rtspsrc location="[^"\\\s]*" latency=/);
        }
      }),
      { numRuns: 500 },
    );
  });

  it('because quotes are escaped', () => {
    expect(quoted('a"b\\c')).toBe('"a\\"b\\\\c"');
  });

  it.each([
    { kind: 'test', width: 15 },
    { kind: 'test', pattern: 'x ! y' },
    { kind: 'test', framesPerS: 0 },
    { kind: 'gst', pipeline: '' },
    { kind: 'gst', pipeline: 'a\0encoder=b' },
    { kind: 'frames', width: 3 },
    { kind: 'screen' },
    null,
  ])('%j is refused', (source) => {
    expect(accepted(source)).toBe(false);
  });
});
