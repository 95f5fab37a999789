import type { Batch, RobotClient, VideoCodec, VideoDescription } from '@farpoint/operator';
import { signal } from '@preact/signals-core';
import { describe, expect, test } from 'vitest';
import { PresentedInstant } from '../../ground/telemetry/presented-instant.ts';
import { RobotVoice } from '../../testing/robot-voice.ts';
import type { ReadFrame } from './readers/open-reader.ts';
import { VideoFeed } from './video-feed.ts';
import { VideoViews } from './video-views.ts';

const OFFSET_MS = 500_000;

/** A feed with stand-ins for the client and for the readers of tracks. */
class Bench extends RobotVoice {
  readonly views = new VideoViews(
    signal(0),
    () => ({ width: 0, height: 0, getContext: () => null }) as unknown as HTMLCanvasElement,
  );
  readonly readers = new Map<string, (frame: ReadFrame) => void>();
  /** What readers were told. */
  readonly codecs: string[] = [];
  readonly feed: VideoFeed;
  readonly presented = new PresentedInstant();
  open = 0;
  closed = 0;

  constructor(options: { synchronised?: boolean; canRead?: boolean } = {}) {
    super();
    const client = { on: this.on, link: { session: { clock: { offsetMs: OFFSET_MS } } } };
    this.feed = new VideoFeed({
      client: client as unknown as RobotClient,
      views: this.views,
      words: { tooOld: 'Update it.', noCodec: 'No codec.' },
      settings: { synchronised: options.synchronised ?? true },
      presented: this.presented,
      now: () => this.nowMs,
      receiver:
        options.canRead === false
          ? null
          : { name: 'native', open: ({ track }, { onFrame }) => this.#read(track.id, onFrame) },
    });
  }

  /** Lists two cameras, and gives the tracks `t0` and `t1`. */
  begin(): this {
    this.views.clear();
    this.say('session', 1);
    const videos: VideoDescription[] = [
      { name: 'left', mid: '1', codec: 'H264' },
      { name: 'right', mid: '2', codec: 'H264' },
    ];
    this.views.list(videos);
    this.say('videos', videos);
    for (const video of [0, 1]) this.track(video, `t${video}`);
    return this;
  }

  track(video: number, id: string, readyState = 'live'): void {
    const track = { id, readyState } as MediaStreamTrack;
    this.say('videoTrack', { video, track, receiver: {} as RTCRtpReceiver });
  }

  /** A frame of the track arrives that was captured now, at a whole multiple of 10 ms. */
  frame(track: string, instantMs = this.nowMs): void {
    this.open++;
    const close = () => {
      this.open--;
      this.closed++;
    };
    const image = { image: {} as ImageBitmap, width: 64, height: 48, rtpTimestamp: null, close };
    this.readers.get(track)?.({
      image,
      rtpTimestamp: ((instantMs + OFFSET_MS) * 90) % 2 ** 32,
      capturedAtMs: null,
    });
  }

  readonly nowMs = 20_000;

  get frames(): (number | undefined)[] {
    return this.views.views.value.map(({ newest }) => newest.value?.number);
  }

  #read(id: string, onFrame: (frame: ReadFrame) => void) {
    this.readers.set(id, onFrame);
    return {
      close: () => this.readers.delete(id),
      useCodec: (codec: VideoCodec) => this.codecs.push(`${id} ${codec}`),
    };
  }
}

const cloudAt = (instantMs: number, frame: number) =>
  ({
    packets: 1,
    frameNumber: () => frame,
    captureTimeUs: () => ((instantMs + OFFSET_MS) * 1000) % 2 ** 32,
  }) as unknown as Batch;

describe('the videos’ feed', () => {
  test('draws together what was captured together, at its own size, and closes every picture', () => {
    const bench = new Bench().begin();
    const { nowMs } = bench;
    bench.frame('t0');
    bench.feed.present(nowMs + 1);
    bench.frame('t1');
    bench.feed.present(nowMs + 2);
    expect(bench.frames).toEqual([1, 1]);
    const [left] = bench.views.views.value;
    expect([left?.canvas.width, left?.newest.value?.takenAtMs]).toEqual([64, nowMs]);
    bench.frame('t0', nowMs + 30);
    bench.feed.present(nowMs + 3);
    // It waits for the other camera's.
    expect(bench.frames).toEqual([1, 1]);
    bench.frame('t1', nowMs + 30);
    bench.feed.present(nowMs + 4);
    expect(bench.frames).toEqual([2, 2]);
    expect([bench.open, bench.closed]).toEqual([0, 4]);
    const stats = bench.feed.stats(nowMs + 4);
    expect(stats.spreadMs?.max).toBe(0);
    expect(stats.videos.map(({ frames }) => frames)).toEqual([2, 2]);
  });

  test('tells of each frame when it comes, even of one that is never drawn', () => {
    const bench = new Bench().begin();
    const told: [number, number, number][] = [];
    bench.feed.onFrame = (video, { width }, captureMs) => told.push([video, width, captureMs]);
    bench.frame('t1');
    bench.frame('t1', bench.nowMs + 30);
    expect(told).toEqual([0, 30].map((later) => [1, 64, bench.nowMs + later + OFFSET_MS]));
  });

  test('unsynchronised, draws each frame at once', () => {
    const bench = new Bench({ synchronised: false }).begin();
    for (const instantMs of [0, 30]) {
      bench.frame('t1', bench.nowMs + instantMs);
      bench.feed.present(bench.nowMs + instantMs);
    }
    expect(bench.frames).toEqual([undefined, 2]);
  });

  test('a frame waits for the cloud captured with it, which is not held back itself', () => {
    const bench = new Bench().begin();
    const { nowMs } = bench;
    bench.views.switches.toggle(1);
    bench.say('cloud', cloudAt(nowMs, 7));
    bench.frame('t0');
    bench.feed.present(nowMs);
    bench.frame('t0', nowMs + 40);
    bench.feed.present(nowMs);
    expect(bench.frames[0]).toBe(1);
    bench.say('cloud', cloudAt(nowMs + 40, 8));
    bench.feed.present(nowMs);
    expect(bench.frames[0]).toBe(2);
    // Only what waits in the compositor is measured.
    expect(bench.feed.stats(nowMs).spreadMs).toBe(null);
  });

  test('tells the reader of another codec, and no other reader', () => {
    const bench = new Bench().begin();
    bench.views.cannotShow(0, 'This browser cannot decode this video.');
    const videos: VideoDescription[] = [
      { name: 'left', mid: '1', codec: 'VP8' },
      { name: 'right', mid: '2', codec: 'H264' },
    ];
    for (let i = 0; i < 2; i++) bench.say('videos', videos);
    expect(bench.codecs).toEqual(['t0 VP8']);
    expect(bench.views.views.value.map(({ fault }) => fault.value)).toEqual([null, null]);
    bench.frame('t0');
    bench.frame('t1');
    bench.feed.present(bench.nowMs);
    expect(bench.frames).toEqual([1, 1]);
  });

  test('reads the videos that are on, and closes what waits of one that is switched off', () => {
    const bench = new Bench().begin();
    expect([...bench.readers.keys()]).toEqual(['t0', 't1']);
    bench.frame('t1');
    bench.views.switches.toggle(1);
    expect([...bench.readers.keys()]).toEqual(['t0']);
    expect(bench.open).toBe(0);
    bench.views.switches.toggle(1);
    expect([...bench.readers.keys()]).toEqual(['t0', 't1']);
    bench.track(0, 'other');
    expect([...bench.readers.keys()].sort()).toEqual(['other', 't1']);
    bench.begin();
    expect([...bench.readers.keys()]).toEqual(['t0', 't1']);
  });

  test('closes a frame whose time cannot be', () => {
    const bench = new Bench().begin();
    bench.frame('t0', bench.nowMs + 5_000_000);
    expect([bench.open, bench.feed.stats(0).undated]).toEqual([0, 1]);
  });

  test('says why this browser shows nothing', () => {
    const old = new Bench({ canRead: false }).begin();
    expect(old.views.views.value[0]?.fault.value).toContain('Update');
    const bench = new Bench().begin();
    bench.track(1, 'refused', 'ended');
    expect(bench.views.views.value.map(({ fault }) => fault.value !== null)).toEqual([false, true]);
  });
});
