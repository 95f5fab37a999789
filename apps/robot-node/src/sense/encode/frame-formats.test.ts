import type { ImageFrame, PointFrame, SourceDescription } from '@farpoint/cloud-source';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { expect, it } from 'vitest';
import type { CodedBudget } from './capture-budget.ts';
import { type FormattedFrame, FrameFormats } from './frame-formats.ts';
import { type CodedFormat, FramePlanner } from './plan.ts';

const codec = await loadCodecFromDisk();
const SIZE = 64;
const CAMERA = { fx: 60, fy: 60, cx: 32, cy: 32 };
const stamp = {
  cameraPose: { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
  capturedAtMs: 1000,
};
const images: ImageFrame = {
  form: 'images',
  depth: new Float32Array(SIZE * SIZE).map((_, i) => 1 + (i % SIZE) / 100),
  colour: new Uint32Array(SIZE * SIZE).fill(0xff808080),
  ...stamp,
};
const lidar: PointFrame = {
  form: 'points',
  points: new Float32Array(3000 * 4).map((_, i) => Math.sin(i) * 5 + 6),
  count: 3000,
  ...stamp,
};
const describe = (camera: boolean): SourceDescription => ({
  kind: 'test',
  ...(camera ? { width: SIZE, height: SIZE, camera: CAMERA } : { width: 3000, height: 1, camera: null }),
  capacity: SIZE * SIZE,
  depthMeasure: 'z',
});

function encode(
  frame: ImageFrame | PointFrame,
  formats: CodedFormat[],
  plainBitsPerSecond: number | null = null,
) {
  const planner = new FramePlanner({
    policy: 'latency',
    mostFramesPerSecond: 30,
    anyRate: false,
    floorFraction: 0.1,
    mostPoints: 1e6,
  });
  const sampling = { lambda: 1, epsilon: 1e-6, nearDistance: 3.85, sensor: 0 };
  const encoder = new FrameFormats(codec, describe(frame.form === 'images'), sampling, planner, () => 0);
  const coded = formats.map(
    (format): CodedBudget => ({ format, targetBitsPerSecond: 20e6, plainBitsPerSecond }),
  );
  const budget = { targetBitsPerSecond: 20e6, overheadBytes: 68, streaming: true, probe: null, coded };
  const request = {
    frameNumber: 1,
    budget,
    probeBytes: 0,
    workMs: 0,
    measuredFramesPerSecond: null,
    latencyTest: false,
  };
  return encoder
    .encode(frame, request)
    .frames.map(({ encoded, audience }: FormattedFrame) => [encoded.format, audience]);
}

it('encodes a camera’s image as organised for everyone who reads it, whatever else they read', () => {
  expect(encode(images, ['organised'])).toEqual([['organised', { readers: 'organised' }]]);
  expect(encode(images, ['organised', 'unorganised'])).toEqual([['organised', { readers: 'organised' }]]);
  expect(encode(images, ['organised'], 1e6)).toEqual([
    ['organised', { readers: 'organised' }],
    ['points64', { others: 'organised' }],
  ]);
});

it('encodes other clouds as unorganised for everyone who reads it', () => {
  expect(encode(lidar, ['unorganised'])).toEqual([['unorganised', { readers: 'unorganised' }]]);
  expect(encode(lidar, ['organised', 'unorganised'], 1e6)).toEqual([
    ['unorganised', { readers: 'unorganised' }],
    ['points64', { others: 'unorganised' }],
  ]);
});

it('sends points64 to everyone if nobody reads a format that fits', () => {
  expect(encode(images, ['unorganised'])).toEqual([['points64', 'everyone']]);
  expect(encode(lidar, ['organised'], 1e6)).toEqual([['points64', 'everyone']]);
  expect(encode(images, [])).toEqual([['points64', 'everyone']]);
});
