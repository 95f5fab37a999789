import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { VideoDecoding } from './video-decoding.ts';

/** As strict as the browser's: unconfigured or closed, it throws; a frame is to be closed once. */
class Decoder {
  static readonly all: Decoder[] = [];
  state: CodecState = 'unconfigured';
  decodeQueueSize = 0;
  configured: VideoDecoderConfig[] = [];
  readonly #init: VideoDecoderInit;
  constructor(init: VideoDecoderInit) {
    this.#init = init;
    Decoder.all.push(this);
  }
  configure(config: VideoDecoderConfig): void {
    if (this.state === 'closed') throw new DOMException('closed', 'InvalidStateError');
    this.state = 'configured';
    this.configured.push(config);
  }
  decode({ timestamp }: EncodedVideoChunk): void {
    if (this.state !== 'configured') throw new DOMException('not configured', 'InvalidStateError');
    this.decodeQueueSize++;
    this.#pending.push(timestamp);
  }
  close(): void {
    if (this.state === 'closed') throw new DOMException('closed', 'InvalidStateError');
    this.state = 'closed';
  }
  readonly #pending: number[] = [];
  /** Finishes the next frame. */
  finish(): void {
    this.decodeQueueSize--;
    open++;
    this.#init.output({ timestamp: this.#pending.shift(), close: () => open-- } as unknown as VideoFrame);
  }
  fail(name: string): void {
    this.state = 'closed';
    this.#init.error(new DOMException('no', name));
  }
}

let open = 0;
const told = { frames: [] as number[], drops: 0, keys: 0, unsupported: [] as string[] };

function decoding(): VideoDecoding {
  return new VideoDecoding('VP8', {
    onFrame: (frame, rtpTimestamp) => {
      told.frames.push(rtpTimestamp);
      frame.close();
    },
    onDrop: () => told.drops++,
    onUnsupported: (detail) => told.unsupported.push(detail),
    requestKeyFrame: () => told.keys++,
    nowMs: () => 0,
  });
}

const frame = (type: 'key' | 'delta') => ({ type, data: new ArrayBuffer(4) }) as RTCEncodedVideoFrame;
const decoder = () => Decoder.all.at(-1) as Decoder;

beforeEach(() => {
  vi.stubGlobal('VideoDecoder', Decoder);
  vi.stubGlobal(
    'EncodedVideoChunk',
    class {
      constructor(init: object) {
        Object.assign(this, init);
      }
    },
  );
  Decoder.all.length = 0;
  open = 0;
  Object.assign(told, { frames: [], drops: 0, keys: 0, unsupported: [] });
});
afterEach(() => vi.unstubAllGlobals());

test('decodes for the least delay, and tells each picture with its RTP timestamp, also after a wrap', () => {
  const video = decoding();
  video.take(frame('key'), 2 ** 32 - 3000);
  video.take(frame('delta'), 0);
  expect(decoder().configured).toEqual([
    { codec: 'vp8', optimizeForLatency: true, hardwareAcceleration: 'no-preference' },
  ]);
  decoder().finish();
  decoder().finish();
  expect(told.frames).toEqual([2 ** 32 - 3000, 0]);
  expect([open, told.keys]).toEqual([0, 0]);
});

test('a decoder that fails is replaced at the next key frame, which is asked for', () => {
  const video = decoding();
  video.take(frame('key'), 3000);
  const first = decoder();
  first.fail('EncodingError');
  video.take(frame('delta'), 6000);
  expect([Decoder.all.length, told.keys, told.drops]).toEqual([1, 1, 2]);
  video.take(frame('key'), 9000);
  expect(Decoder.all.length).toBe(2);
  decoder().finish();
  expect(told.frames).toEqual([9000]);
});

test('a decoder that falls behind gets no more than a few frames', () => {
  const video = decoding();
  for (let i = 1; i < 30; i++) video.take(frame(i === 1 ? 'key' : 'delta'), i * 3000);
  expect(decoder().decodeQueueSize).toBe(6);
  expect([told.drops, told.keys]).toEqual([23, 1]);
});

test('a video that the browser does not decode is given up, with its words', () => {
  const video = decoding();
  video.take(frame('key'), 3000);
  decoder().fail('NotSupportedError');
  video.take(frame('key'), 6000);
  expect([told.unsupported, Decoder.all.length]).toEqual([['no'], 1]);
});

test('once closed, what the decoder still finishes is closed and not told', () => {
  const video = decoding();
  video.take(frame('key'), 3000);
  video.close();
  decoder().finish();
  expect([told.frames, open, decoder().state]).toEqual([[], 0, 'closed']);
});
