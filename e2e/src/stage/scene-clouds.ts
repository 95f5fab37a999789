/** Clouds of fixed scenes, written by the codec's encoders: what a robot with such a sensor would send. */
import {
  bytesOfPoints,
  type CloudFormat,
  emptyPlacement,
  encodeUnorganisedStream,
  MAX_POINT_DATA_BYTES,
  PLACEMENT_BYTES,
  POINT_PACKET_HEADER_BYTES,
  packetCountOf,
  pointsOfBytes,
  writePlacement,
  writePointPacketHeader,
} from '@farpoint/protocol';
import { type Codec, OrganisedEncoder, Points64Encoder, UnorganisedEncoder } from '@farpoint/wasm-codec';
import type { CloudFile } from '@farpoint/webxr/cloud-file';
import type { Place } from '../place.ts';

const GREY = 0x80;
/** Of a LiDAR's coordinates. */
const UNIT_MM = 5;

/** One payload: header, data, and a placement that the page replaces. */
function payload(
  data: Uint8Array,
  [points, offset, ofFrame]: readonly [points: number, offset: number, ofFrame: number],
  format: CloudFormat,
): string {
  const bytes = new Uint8Array(POINT_PACKET_HEADER_BYTES + data.length + PLACEMENT_BYTES);
  const view = new DataView(bytes.buffer);
  writePointPacketHeader(view, 0, {
    ...{ frameNumber: 0, frameLength: bytesOfPoints(ofFrame) },
    ...{ sequenceOffset: bytesOfPoints(offset), sequenceLength: bytesOfPoints(points) },
  });
  bytes.set(data, POINT_PACKET_HEADER_BYTES);
  writePlacement(view, POINT_PACKET_HEADER_BYTES + data.length, { ...emptyPlacement(), format });
  return Buffer.from(bytes).toString('base64');
}

/** @param places seen from the camera: ahead, to the left, up */
export function points64(codec: Codec, places: readonly Place[]): CloudFile {
  using encoder = new Points64Encoder(codec, places.length);
  const { frame, frameBits } = encoder;
  for (const [i, [x, y, z]] of places.entries()) {
    frame.set([-y, -z, x], i * 4);
    frameBits[i * 4 + 3] = 0xff00_0000 + GREY * 0x01_0101;
  }
  encoder.sample({ points: places.length, count: places.length, seed: 1 });
  const { points } = encoder.pack();
  const { stride, dataOffset } = encoder.layout;
  const packets = Array.from({ length: packetCountOf(points) }, (_, i) => {
    const offset = i * pointsOfBytes(MAX_POINT_DATA_BYTES);
    const count = Math.min(pointsOfBytes(MAX_POINT_DATA_BYTES), points - offset);
    const at = i * stride + dataOffset;
    const data = encoder.packets.slice(at, at + bytesOfPoints(count));
    return payload(data, [count, offset, points], 'points64');
  });
  return { frames: [packets] };
}

/** @param places as in {@link points64} */
export function unorganised(codec: Codec, places: readonly Place[]): CloudFile {
  using encoder = new UnorganisedEncoder(codec, places.length);
  const { frame, frameBits } = encoder;
  for (const [i, place] of places.entries()) {
    frame.set(place, i * 4);
    frameBits[i * 4 + 3] = 0xff00_0000 + (GREY + (i % 64)) * 0x01_0101;
  }
  const { kept, packets: count } = encoder.encode({ points: places.length, attribute: 'colour' });
  let offset = 0;
  const packets = Array.from({ length: count }, (_, i) => {
    const points = encoder.pointsOf(i);
    const packet = payload(encoder.packet(i).slice(), [points, offset, kept], 'unorganised');
    offset += points;
    return packet;
  });
  const header = encodeUnorganisedStream({ unitMm: UNIT_MM });
  return {
    stream: { format: 'unorganised', header: Buffer.from(header).toString('base64') },
    axes: 'body',
    frames: [packets],
  };
}

const [WIDTH, HEIGHT, FOCAL] = [240, 180, 150];
const camera = { fx: FOCAL, fy: FOCAL, cx: WIDTH / 2 - 0.5, cy: HEIGHT / 2 - 0.5 };

/** A floor 1 m below the camera, a wall 4 m ahead of it, and a box on the floor, 2 m ahead. */
export function organised(codec: Codec): CloudFile {
  using encoder = new OrganisedEncoder(codec, { width: WIDTH, height: HEIGHT });
  for (let i = 0; i < WIDTH * HEIGHT; i++) {
    const [u, v] = [i % WIDTH, Math.floor(i / WIDTH)];
    const [right, down] = [(u - camera.cx) / FOCAL, (v - camera.cy) / FOCAL];
    const floor = down > 0 ? 1 / down : Number.POSITIVE_INFINITY;
    const isBox = Math.abs(2 * right) < 0.4 && down > 0.25 && 2 * down < 1;
    encoder.depth[i] = isBox ? 2 : Math.min(4, floor);
    const texture = GREY + ((u * 7 + v * 13) % 32);
    encoder.colour[i] = 0xff00_0000 + (isBox ? 0x2020c0 : texture * 0x01_0101);
  }
  const header = encoder.begin(camera, { fromImages: true }).slice();
  const { points, packets: count } = encoder.encode({ fromImages: true, depthLevel: 1 });
  let offset = 0;
  const packets = Array.from({ length: count }, (_, i) => {
    const inPacket = encoder.lengths[i * 2 + 1] as number;
    const packet = payload(encoder.packet(i).slice(), [inPacket, offset, points], 'organised');
    offset += inPacket;
    return packet;
  });
  return {
    stream: { format: 'organised', header: Buffer.from(header).toString('base64') },
    frames: [packets],
  };
}
