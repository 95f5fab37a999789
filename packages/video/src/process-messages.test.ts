import { describe, expect, it } from 'vitest';
import { parseEncoders, parseError, parseLogLine, parseState } from './process-messages.ts';
import { videoFailure, withoutPasswords } from './video-failure.ts';
import { VideoWireError } from './wire.ts';

const bytes = (value: unknown) => new TextEncoder().encode(JSON.stringify(value));

describe('what the process says', () => {
  it('is checked', () => {
    const playing = {
      ...{ state: 'playing', codec: 'h264', encoder: 'x264enc' },
      ...{ width: 640, height: 480, sourceWidth: 1280, sourceHeight: 960 },
    };
    expect(parseState(bytes(playing))).toEqual(playing);
    expect(() => parseState(bytes({ ...playing, width: -1 }))).toThrow(VideoWireError);
    const error = { reason: 'parse', said: 'no element "x"', detail: '' };
    expect(parseError(bytes(error))).toEqual(error);
    expect(() => parseError(bytes({ ...error, reason: 'other' }))).toThrow(VideoWireError);
    expect(() => parseEncoders(bytes({ gstreamer: '1.22.0' }))).toThrow(VideoWireError);
  });

  it.each(['', '\xff', '{"a', 'null', '7', '[]', '{"__proto__":{}}'])(
    'is refused by a typed error: %j',
    (text) => {
      for (const parse of [parseState, parseError, parseEncoders])
        expect(() => parse(new TextEncoder().encode(text))).toThrow(VideoWireError);
    },
  );

  it('on the standard error may be anything', () => {
    expect(parseLogLine('{"level":"error","msg":"x"}')).toEqual({ level: 'error', msg: 'x' });
    expect(parseLogLine('Opening in BLOCKING MODE')).toEqual({
      level: 'warn',
      msg: 'Opening in BLOCKING MODE',
    });
    expect(parseLogLine('{"level":"loud"}')).toEqual({ level: 'warn', msg: '{"level":"loud"}' });
  });
});

describe('a failure', () => {
  it('says what is wrong, in GStreamer’s words, and what to do', () => {
    expect(videoFailure('parse', 'syntax error')).toEqual({
      reason: 'parse',
      sentence: 'the source is no valid pipeline: syntax error',
      remedy: expect.stringContaining('gst-launch-1.0') as string,
      retried: false,
    });
  });

  it('does not tell a camera’s password', () => {
    expect(withoutPasswords('cannot open rtsp://me:secret@10.0.0.5/a, rtsps://you@b/')).toBe(
      'cannot open rtsp://…@10.0.0.5/a, rtsps://…@b/',
    );
  });
});
