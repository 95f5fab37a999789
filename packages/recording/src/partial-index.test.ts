/** MCAP files whose writers left out what is optional. */
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import { openRecording } from './open-recording.ts';
import { cloudMessage, mcapOf, START_NS, type Summary, writeFile } from './testing/files.ts';
import { playClouds } from './testing/play-clouds.ts';

const CLOUDS = 20;
const folder = useFolder();

const left: [string, Summary & { useChunks?: boolean }][] = [
  ['an index of messages', { useMessageIndex: false }],
  ['an index of chunks', { useChunkIndex: false }],
  ['statistics', { useStatistics: false }],
  ['channels', { repeatChannels: false }],
  ['schemas', { repeatSchemas: false }],
  ['channels and schemas', { repeatChannels: false, repeatSchemas: false }],
  [
    'anything',
    {
      ...{ useMessageIndex: false, useChunkIndex: false, useStatistics: false },
      ...{ repeatChannels: false, repeatSchemas: false },
    },
  ],
  ['chunks', { useChunks: false }],
];

describe.each(left)('a recording without %s', (_, summary) => {
  const make = async () =>
    writeFile(join(folder, 'partial.mcap'), await mcapOf(CLOUDS, (k) => cloudMessage(k, 100), summary));

  it('has its topics, its length, and all of its messages from any time on', async () => {
    const recording = await openRecording(await make());
    expect(recording.warning).toBeNull();
    expect(recording.topics.map(({ name, type }) => [name, type])).toEqual([
      ['/points', 'sensor_msgs/msg/PointCloud2'],
    ]);
    const at = (k: number) => START_NS + BigInt(k) * 100_000_000n;
    expect([recording.startNs, recording.endNs]).toEqual([at(0), at(CLOUDS - 1)]);
    for (const from of [0, 1, 7, CLOUDS - 1]) {
      const times: bigint[] = [];
      for await (const { logNs } of recording.messages(['/points'], at(from))) times.push(logNs);
      expect(times).toEqual(Array.from({ length: CLOUDS - from }, (_, k) => at(from + k)));
    }
    await recording.close();
  });

  it('is played', async () => {
    expect((await playClouds({ path: await make() })).shown).toHaveLength(CLOUDS);
  });
});
