import type { PointFrame } from '@farpoint/cloud-source';
import {
  emptyPlacement,
  emptyPointPacketHeader,
  isLatencyTestBlock,
  MAX_CLOUD_PAYLOAD_BYTES,
  packColour664,
  readCloudPayload,
  writePlacement,
  writePointPacketHeader,
  writePoints64Block,
} from '@farpoint/protocol';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, it } from 'vitest';
import { SLOT_BYTES, slotPayload, slotSequenceOffset } from './packetiser.ts';
import { Points64FrameEncoder } from './points64-frame-encoder.ts';

const codec = await loadCodecFromDisk();
const sampling = { lambda: 3, epsilon: 1e-6, nearDistance: 3.85, depthMeasure: 'z', sensor: 0 } as const;
const CAPACITY = 1000;

const SOURCE = { capacity: CAPACITY, width: CAPACITY, height: 1, camera: null };

function cloud(count: number): PointFrame {
  const points = new Float32Array(count * 4);
  const words = new Uint32Array(points.buffer);
  for (let i = 0; i < count; i++) {
    points[i * 4] = i / 100;
    points[i * 4 + 1] = -i / 300;
    points[i * 4 + 2] = 1 + i / 200;
    // Some of these bit patterns are NaN as floats.
    words[i * 4 + 3] = (i * 2_654_435_761) >>> 0;
  }
  return {
    form: 'points',
    points,
    count,
    cameraPose: { position: { x: 1, y: -2, z: 0.5 }, orientation: { x: 0, y: 0, z: 0.6, w: 0.8 } },
    // One second after the microsecond timestamp wraps.
    capturedAtMs: 4_294_967.296 + 1000,
  };
}

/** A plain implementation of the format: the packets of a frame of which every point is sent. */
function expectedPayload(frame: PointFrame, frameNumber: number, index: number): Uint8Array {
  const first = index * 150;
  const count = Math.min(150, frame.count - first);
  const payload = new Uint8Array(16 + count * 8 + 28);
  const view = new DataView(payload.buffer);
  writePointPacketHeader(view, 0, {
    frameNumber,
    frameLength: frame.count * 8,
    sequenceOffset: first * 8,
    sequenceLength: count * 8,
  });
  const bytes = new Uint8Array(frame.points.buffer);
  const positions = new Float32Array(frame.count * 3).map(
    (_, k) => frame.points[Math.floor(k / 3) * 4 + (k % 3)] as number,
  );
  const colours = Uint16Array.from({ length: frame.count }, (_, i) =>
    packColour664(bytes[i * 16 + 12] as number, bytes[i * 16 + 13] as number, bytes[i * 16 + 14] as number),
  );
  writePoints64Block(view, 16, positions, colours, first, count);
  writePlacement(view, 16 + count * 8, {
    ...emptyPlacement(),
    pose: frame.cameraPose,
    captureTimeUs: 1_000_000,
  });
  return payload;
}

describe('Points64FrameEncoder', () => {
  it.each([1, 149, 150, 151, 450, 701])('makes exactly the protocol’s bytes for %i points', (count) => {
    const encoder = new Points64FrameEncoder(codec, SOURCE, sampling, () => 0);
    const frame = cloud(count);
    for (const frameNumber of [0, 1]) {
      const encoded = encoder.encode(frame, frameNumber, CAPACITY, false);
      expect(encoded).toMatchObject({ frameNumber, points: count, packets: Math.ceil(count / 150) });
      const slots = new Uint8Array(encoded.packets * SLOT_BYTES);
      encoder.copyPackets(slots, encoded.packets);
      for (let i = 0; i < encoded.packets; i++) {
        expect(slotPayload(slots, i)).toEqual(expectedPayload(frame, frameNumber, i));
        expect(slotSequenceOffset(slots, i)).toBe(i * 1200);
      }
    }
  });

  it('gives the same result for a camera’s images and for their points', () => {
    const [width, height, camera] = [40, 25, { fx: 30, fy: 31, cx: 19.5, cy: 12.5 }];
    const { points, ...stamp } = cloud(width * height);
    const depth = Float32Array.from({ length: width * height }, (_, i) => (i % 9 === 0 ? 0 : 1 + i / 200));
    const colour = new Uint32Array(points.buffer).filter((_, i) => i % 4 === 3);
    for (let i = 0; i < depth.length; i++) {
      const z = depth[i] as number;
      points[i * 4] = Math.fround(((i % width) - camera.cx) / camera.fx) * z;
      points[i * 4 + 1] = Math.fround((Math.floor(i / width) - camera.cy) / camera.fy) * z;
      points[i * 4 + 2] = z;
    }
    const byPoints = new Points64FrameEncoder(codec, SOURCE, sampling, () => 0);
    const byImages = new Points64FrameEncoder(codec, { ...SOURCE, width, height, camera }, sampling, () => 0);
    const encoded = byPoints.encode({ ...stamp, points }, 3, 300, false);
    expect(byImages.encode({ ...stamp, form: 'images', depth, colour }, 3, 300, false)).toEqual(encoded);
    const packets = [byPoints, byImages].map((encoder) => {
      const slots = new Uint8Array(encoded.packets * SLOT_BYTES);
      encoder.copyPackets(slots, encoded.packets);
      return slots;
    });
    expect(packets[1]).toEqual(packets[0]);
  });

  it('counts what it leaves out, and marks a latency-test frame green', () => {
    const encoder = new Points64FrameEncoder(codec, SOURCE, sampling, () => 0);
    const frame = cloud(600);
    frame.points[0] = Number.NaN;
    frame.points[6] = -1;
    frame.points[8] = 40;
    const encoded = encoder.encode(frame, 0, 300, true);
    expect(encoded).toMatchObject({ points: 300, packets: 2, validPoints: 597 });
    expect(encoded.rejected).toEqual({ notFinite: 1, nonPositiveDepth: 1, outOfRange: 1, notDrawn: 297 });
    const slots = new Uint8Array(2 * SLOT_BYTES);
    encoder.copyPackets(slots, 2);
    const view = new DataView(slots.buffer, SLOT_BYTES, MAX_CLOUD_PAYLOAD_BYTES);
    const header = emptyPointPacketHeader();
    const placement = emptyPlacement();
    expect(readCloudPayload(view, header, placement)).toBeNull();
    expect(header).toMatchObject({ frameLength: 2400, sequenceOffset: 1200 });
    expect(placement.latencyTest).toBe(true);
    expect(isLatencyTestBlock(view, 16, 1200)).toBe(true);
  });

  it('sends nothing for a frame without a valid point', () => {
    const encoder = new Points64FrameEncoder(codec, SOURCE, sampling, () => 0);
    const frame = cloud(10);
    frame.points.fill(Number.NaN);
    expect(encoder.encode(frame, 0, 10, false)).toMatchObject({ points: 0, packets: 0, validPoints: 0 });
  });
});
