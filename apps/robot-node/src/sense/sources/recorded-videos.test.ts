import type { RecordedMessage, RecordedTopic } from '@farpoint/recording';
import { beforeEach, describe, expect, it } from 'vitest';
import { RecordedVideos } from './recorded-videos.ts';

const topicOf = (
  name: string,
  camera?: string,
  type = 'foxglove_msgs/msg/CompressedVideo',
): RecordedTopic => ({
  ...{ name, type, messages: 10 },
  metadata: new Map(camera === undefined ? [] : [['camera', camera]]),
  decode: (data) => JSON.parse(new TextDecoder().decode(data)) as unknown,
});
const FRONT = topicOf('/farpoint/videos/Front', 'Front');

const message = (topic: RecordedTopic, key: boolean, n: number, format = 'vp8'): RecordedMessage => {
  const data = Buffer.from([key ? 0x10 : 0x11, n]).toString('base64');
  const video = { timestamp: { sec: 0, nanosec: 0 }, frame_id: '', format, data };
  return { topic, logNs: 0n, offset: 0, data: new TextEncoder().encode(JSON.stringify(video)) };
};

describe('RecordedVideos', () => {
  let nowMs: number;
  let videos: RecordedVideos;
  let got: [n: number, capturedAtMs: number][];
  const take = (key: boolean, n: number, ageMs = 0) => videos.take(message(FRONT, key, n), nowMs - ageMs);

  beforeEach(() => {
    nowMs = 1000;
    got = [];
    videos = new RecordedVideos([topicOf('/points', undefined, 'other'), FRONT], []);
    videos.onPicture = (_, { bytes, capturedAtMs }) => got.push([bytes[1]!, capturedAtMs]);
  });

  it('are named after their cameras, else their topics, each differently', () => {
    const topics = [
      FRONT,
      topicOf('/copy', 'Front'),
      topicOf('/mast'),
      topicOf('/odd', ' \u0000'),
      topicOf('/taken'),
    ];
    const named = new RecordedVideos([...topics, { ...topicOf('/empty'), messages: 0 }], ['/taken']);
    expect(named.videos).toEqual([
      { name: 'Front', topic: '/farpoint/videos/Front' },
      { name: 'Front 2', topic: '/copy' },
      { name: '/mast', topic: '/mast' },
      { name: '/odd', topic: '/odd' },
    ]);
  });

  it('begin with the last key frame when somebody begins to watch', () => {
    take(false, 0);
    take(true, 1);
    take(true, 2, 40);
    nowMs = 1033;
    take(false, 3);
    expect(got).toEqual([]);
    videos.watch(0, true);
    expect(got).toEqual([
      [2, expect.closeTo(1000.01, 6)],
      [3, 1033],
    ]);
    nowMs = 1066;
    take(false, 4);
    videos.watch(0, false);
    take(false, 5);
    expect(got.map(([n]) => n)).toEqual([2, 3, 4]);
  });

  it('carry the time at which they were due', () => {
    videos.watch(0, true);
    take(true, 1, 12.5);
    expect(got).toEqual([[1, 987.5]]);
  });

  it('go on with a key frame after a jump, with times that rise', () => {
    videos.watch(0, true);
    take(true, 1);
    videos.restart();
    take(false, 2);
    take(true, 3, 500);
    take(false, 4, 467);
    nowMs = 1040;
    take(false, 5);
    expect(got.map(([n]) => n)).toEqual([1, 3, 4, 5]);
    const times = got.map(([, ms]) => ms);
    expect(times.every((ms, i) => i === 0 || ms > times[i - 1]!)).toBe(true);
    expect(times.at(-1)).toBe(1040);
  });

  it('refuse what cannot be decoded, and leave other topics alone', () => {
    expect(() => videos.take(message(FRONT, true, 1, 'av1'), 0)).toThrow('video in av1, not h264 or vp8');
    expect(() => videos.begins(message(FRONT, true, 1, ''))).toThrow('no format');
    expect(videos.take(message(topicOf('/other'), true, 1), 0)).toBe(false);
    videos.watch(7, true);
    expect(videos.watched).toBe(false);
  });
});
