/** Small recordings generated here, for tests that need no other software. */
import { writeFileSync } from 'node:fs';
import { parse } from '@foxglove/rosmsg';
import { MessageWriter } from '@foxglove/rosmsg2-serialization';
import { McapWriter } from '@mcap/core';
import { POINT_CLOUD2_SCHEMA } from '../ros-schemas.ts';

export { POINT_CLOUD2_SCHEMA };

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

/** The contents of one topic of an MCAP file. */
export interface TestTopic {
  topic: string;
  /** As in its schema. */
  type: string;
  messageEncoding?: string;
  schemaEncoding?: string;
  schema?: string;
  messages: readonly { logNs: bigint; data: Uint8Array }[];
}

/** What a writer may leave out of its summary. */
export type Summary = Partial<
  Record<'useMessageIndex' | 'useChunkIndex' | 'useStatistics' | 'repeatChannels' | 'repeatSchemas', boolean>
>;

/** Messages of several topics, in order of time. */
export async function mcapOfTopics(
  topics: readonly TestTopic[],
  chunkSize = 4096,
  summary: Summary & { useChunks?: boolean } = {},
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
    ...{ chunkSize, ...summary },
  });
  await mcap.start({ profile: 'ros2', library: 'test' });
  const all: { channelId: number; sequence: number; logTime: bigint; data: Uint8Array }[] = [];
  for (const { topic, type, messages, ...encoding } of topics) {
    const data = new TextEncoder().encode(encoding.schema ?? '');
    const schemaId = await mcap.registerSchema({
      ...{ name: type, encoding: encoding.schemaEncoding ?? 'ros2msg', data },
    });
    const messageEncoding = encoding.messageEncoding ?? 'cdr';
    const channelId = await mcap.registerChannel({ schemaId, topic, messageEncoding, metadata: new Map() });
    messages.forEach(({ logNs, data }, sequence) => {
      all.push({ channelId, sequence, logTime: logNs, data });
    });
  }
  all.sort((a, b) => Number(a.logTime - b.logTime));
  for (const message of all) await mcap.addMessage({ ...message, publishTime: message.logTime });
  await mcap.end();
  return Buffer.concat(pieces);
}

/** When the first message of such a file was recorded. */
export const START_NS = 1_000_000_000n;

/** 10 clouds per second. @param message the bytes of cloud k */
export function mcapOf(
  clouds: number,
  message: (k: number) => Uint8Array,
  {
    type = 'sensor_msgs/msg/PointCloud2',
    chunkSize = 4096,
    ...summary
  }: { type?: string; chunkSize?: number; useChunks?: boolean } & Summary = {},
): Promise<Uint8Array> {
  const messages = Array.from({ length: clouds }, (_, k) => ({
    logNs: START_NS + BigInt(k) * 100_000_000n,
    data: message(k),
  }));
  return mcapOfTopics(
    [{ topic: '/points', type, schema: POINT_CLOUD2_SCHEMA, messages }],
    chunkSize,
    summary,
  );
}

export function writeFile(path: string, bytes: Uint8Array): string {
  writeFileSync(path, bytes);
  return path;
}
