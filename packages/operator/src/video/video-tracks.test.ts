import { expect, test } from 'vitest';
import { playWithoutDelay, type VideoTrack, videoOfStreams } from './video-track.ts';
import { VideoTracks } from './video-tracks.ts';

const receiver = {} as RTCRtpReceiver;
const track = (id: string) => ({ id }) as MediaStreamTrack;

function bench(): { tracks: VideoTracks; told: string[] } {
  const told: string[] = [];
  const tracks = new VideoTracks((each: VideoTrack) => told.push(`${each.video}:${each.track.id}`));
  return { tracks, told };
}

test('a stream’s id tells the number of its video', () => {
  expect(videoOfStreams(['farpoint-video-0'])).toBe(0);
  expect(videoOfStreams(['other', 'farpoint-video-7'])).toBe(7);
  const wrong = [
    'farpoint-video-8',
    'farpoint-video-01',
    'farpoint-video-',
    'farpoint-cloud',
    'farpoint-video--1',
  ];
  for (const id of wrong) expect(videoOfStreams([id])).toBe(null);
  expect(videoOfStreams([])).toBe(null);
});

test('asks for no delay by both names', () => {
  const receiver = {} as RTCRtpReceiver;
  playWithoutDelay(receiver);
  expect(receiver).toEqual({ jitterBufferTarget: 0, playoutDelayHint: 0 });
});

test('tracks that come before the list wait for it', () => {
  const { tracks, told } = bench();
  tracks.add({ video: 1, track: track('b'), receiver });
  tracks.add({ video: 0, track: track('a'), receiver });
  expect(told).toEqual([]);
  tracks.list(1);
  expect(told).toEqual(['0:a']);
  tracks.list(2);
  tracks.list(2);
  expect(told).toEqual(['0:a', '1:b']);
});

test('a track is announced once, another one for the same video too, and none of an earlier session', () => {
  const { tracks, told } = bench();
  tracks.list(1);
  const first = track('a');
  tracks.add({ video: 0, track: first, receiver });
  tracks.add({ video: 0, track: first, receiver });
  tracks.add({ video: 0, track: track('b'), receiver });
  expect(told).toEqual(['0:a', '0:b']);
  tracks.add({ video: 1, track: track('old'), receiver });
  tracks.reset();
  tracks.list(2);
  expect(told).toHaveLength(2);
});
