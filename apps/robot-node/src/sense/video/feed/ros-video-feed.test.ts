import type { TopicEntry } from '@farpoint/ros';
import { MemoryGraph } from '@farpoint/ros/testing';
import type { CodedPicture, RawFrame } from '@farpoint/video';
import { describe, expect, it } from 'vitest';
import { RosVideoFeed } from './ros-video-feed.ts';

const IMAGE = 'sensor_msgs/msg/Image';
const COMPRESSED = 'sensor_msgs/msg/CompressedImage';
const TOPIC = '/front/image';
const WALL_S = 1_700_000_000;
/** The robot's clock when the wall clock shows WALL_S. */
const BEGAN_MS = 1000;

function setUp(version: 1 | 2, type = IMAGE) {
  const clock = { ms: BEGAN_MS };
  const now = () => clock.ms;
  const graph = new MemoryGraph(version, now);
  const frames: (RawFrame | CodedPicture)[] = [];
  const faults: string[] = [];
  const target = {
    takes: true,
    pushFrame: (frame: RawFrame) => frames.push({ ...frame, bytes: frame.bytes.slice() }) > 0,
    pushCoded: (picture: CodedPicture) => frames.push({ ...picture, bytes: picture.bytes.slice() }) > 0,
  };
  const entry: TopicEntry = { topic: TOPIC, type, as: 'picture', most: null };
  const wallNs = () => BigInt(WALL_S) * 1_000_000_000n + BigInt(Math.round((clock.ms - BEGAN_MS) * 1e6));
  const feed = new RosVideoFeed(graph, entry, { now, wallNs }, target, {
    onFault: (fault) => faults.push(fault),
  });
  return { clock, graph, frames, faults, target, feed };
}

const headerAt = (ms: number) => ({
  stamp: { sec: WALL_S + Math.floor(ms / 1000), nanosec: (ms % 1000) * 1e6, nsec: (ms % 1000) * 1e6 },
  frame_id: 'camera',
  seq: 0,
});
function image(ms: number, encoding = 'rgb8', width = 4, height = 2, pixelBytes = 3) {
  const data = Uint8Array.from({ length: width * height * pixelBytes }, (_, i) => i);
  return {
    header: headerAt(ms),
    ...{ width, height, encoding, is_bigendian: 0, step: width * pixelBytes, data },
  };
}

describe.each([1, 2] as const)('a topic of ROS %i', (version) => {
  it('gives its images as they are, at the instants of their stamps on the robot’s clock', () => {
    const { clock, graph, frames, faults } = setUp(version);
    clock.ms = BEGAN_MS + 70;
    graph.say(TOPIC, IMAGE, image(40));
    clock.ms += 33;
    graph.say(TOPIC, IMAGE, image(75, 'mono8', 6, 4, 1));
    expect(frames).toMatchObject([
      { captureNs: 1_040_000_000n, format: 'rgb', width: 4, height: 2 },
      { captureNs: 1_075_000_000n, format: 'gray', width: 6, height: 4 },
    ]);
    expect([...frames[0]!.bytes]).toEqual(Array.from({ length: 24 }, (_, i) => i));
    expect(faults).toEqual([]);
  });

  it('with a stamp of another clock is taken at its arrival, with an old one when it says', () => {
    const { clock, graph, frames } = setUp(version);
    clock.ms = BEGAN_MS + 70;
    graph.say(TOPIC, IMAGE, image(-100_000_000));
    graph.say(TOPIC, IMAGE, image(900));
    clock.ms = BEGAN_MS + 2070;
    graph.say(TOPIC, IMAGE, image(50));
    expect(frames.map(({ captureNs }) => captureNs)).toEqual([
      1_070_000_000n,
      1_070_000_000n,
      1_050_000_000n,
    ]);
  });

  it('says what it cannot show, and goes on', () => {
    const { graph, frames, faults } = setUp(version);
    graph.say(TOPIC, IMAGE, image(0, 'rgb12'));
    graph.sayBytes(TOPIC, new Uint8Array([1, 2, 3]));
    expect(faults).toHaveLength(2);
    expect(faults[0]).toMatch(/\/front\/image: a picture as rgb12; the encodings are/);
    graph.say(TOPIC, IMAGE, image(0));
    expect(frames).toHaveLength(1);
  });

  it('is not even read while the process takes the picture before', () => {
    const { graph, frames, faults, target } = setUp(version);
    target.takes = false;
    graph.say(TOPIC, IMAGE, image(0, 'rgb12'));
    graph.say(TOPIC, IMAGE, image(0));
    expect([frames, faults]).toEqual([[], []]);
    target.takes = true;
    graph.say(TOPIC, IMAGE, image(0));
    expect(frames).toHaveLength(1);
  });

  it('of compressed pictures passes them on as they are', () => {
    const { graph, frames, faults } = setUp(version, COMPRESSED);
    const say = (format: string, ...data: number[]) =>
      graph.say(TOPIC, COMPRESSED, { header: headerAt(0), format, data: Uint8Array.from(data) });
    say('bgr8; jpeg compressed bgr8', 0xff, 0xd8, 1);
    say('', 0x89, 0x50, 2);
    say('h264', 0, 0, 0, 1, 0x65);
    expect(frames).toMatchObject([
      { captureNs: 1_000_000_000n, coding: 'jpeg', bytes: Uint8Array.of(0xff, 0xd8, 1) },
      { coding: 'png', bytes: Uint8Array.of(0x89, 0x50, 2) },
      { coding: 'h264', bytes: Uint8Array.of(0, 0, 0, 1, 0x65) },
    ]);
    say('16UC1; compressedDepth png', 0, 0, 0, 0);
    say('jpeg');
    expect(faults[0]).toMatch(/compressedDepth png\) that is neither JPEG, PNG nor H.264/);
    expect(faults).toHaveLength(2);
  });

  it('that is silent says so, and why', () => {
    const { clock, graph, faults, feed } = setUp(version);
    clock.ms += 4999;
    feed.check(clock.ms);
    expect(faults).toEqual([]);
    clock.ms++;
    feed.check(clock.ms);
    graph.others = [{ topic: TOPIC, type: COMPRESSED, publishers: 1, subscribers: 0 }];
    feed.check(clock.ms);
    graph.others = [{ topic: TOPIC, type: IMAGE, publishers: 2, subscribers: 0 }];
    feed.check(clock.ms);
    expect(faults).toEqual([
      '/front/image: nobody publishes it (no picture for 5 s)',
      '/front/image: it has sensor_msgs/msg/CompressedImage, not sensor_msgs/msg/Image; set the camera’s type, or name another topic',
      '/front/image: no picture for 5 s, although it is published',
    ]);
    graph.say(TOPIC, IMAGE, image(0));
    feed.check(clock.ms + 100);
    expect(faults).toHaveLength(3);
  });

  it('is left when the camera closes', () => {
    const { graph, frames, feed } = setUp(version);
    feed.close();
    graph.say(TOPIC, IMAGE, image(0));
    expect(frames).toEqual([]);
  });
});
