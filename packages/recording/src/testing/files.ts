/** Small recordings made here, for tests that need no peer. */
import { writeFileSync } from 'node:fs';
import { parse } from '@foxglove/rosmsg';
import { MessageWriter } from '@foxglove/rosmsg2-serialization';
import { McapWriter } from '@mcap/core';
import { POINT_CLOUD2_SCHEMA } from '../ros-schemas.ts';

const writer = new MessageWriter(parse(POINT_CLOUD2_SCHEMA, { ros2: true }));

/** A cloud of `points` points at (k, i, 1). */
export function cloudMessage(k: number, points: number, frameId = 'camera_optical_frame'): Uint8Array {
  const data = new Float32Array(points * 3);
  for (let i = 0; i < points; i++) data.set([k, i, 1], i * 3);
  const field = (name: string, offset: number) => ({ name, offset, datatype: 7, count: 1 });
  return writer.writeMessage({
    header: { stamp: { sec: 0, nanosec: 0 }, frame_id: frameId },
    ...{ height: 1, width: points, fields: [field('x', 0), field('y', 4), field('z', 8)] },
    ...{ is_bigendian: false, point_step: 12, row_step: points * 12, is_dense: true },
    data: new Uint8Array(data.buffer),
  });
}

/** 10 clouds a second. @param message the bytes of cloud k */
export async function mcapOf(
  clouds: number,
  message: (k: number) => Uint8Array,
  { type = 'sensor_msgs/msg/PointCloud2', chunkSize = 4096 } = {},
): Promise<Uint8Array> {
  const pieces: Uint8Array[] = [];
  let position = 0;
  const mcap = new McapWriter({
    writable: {
      position: () => BigInt(position),
      write: async (bytes) => {
        pieces.push(bytes.slice());
        position += bytes.length;
      },
    },
    chunkSize,
  });
  await mcap.start({ profile: 'ros2', library: 'test' });
  const data = new TextEncoder().encode(POINT_CLOUD2_SCHEMA);
  const schemaId = await mcap.registerSchema({ name: type, encoding: 'ros2msg', data });
  const channelId = await mcap.registerChannel({
    ...{ schemaId, topic: '/points', messageEncoding: 'cdr', metadata: new Map() },
  });
  for (let k = 0; k < clouds; k++) {
    const logTime = 1_000_000_000n + BigInt(k) * 100_000_000n;
    await mcap.addMessage({ channelId, sequence: k, logTime, publishTime: logTime, data: message(k) });
  }
  await mcap.end();
  return Buffer.concat(pieces);
}

export function writeFile(path: string, bytes: Uint8Array): string {
  writeFileSync(path, bytes);
  return path;
}
