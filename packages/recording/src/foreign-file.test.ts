import { mkdirSync, mkdtempSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import { openRecording } from './open-recording.ts';
import { mcapOfTopics } from './testing/files.ts';
import { playClouds } from './testing/play-clouds.ts';

const folder = useFolder();
const text = (words: string) => new TextEncoder().encode(words);

describe('what is no recording says what it is', () => {
  it.each([
    ['nothing', new Uint8Array(0), 'is empty'],
    ['zstd', Uint8Array.of(0x28, 0xb5, 0x2f, 0xfd, 0, 0), 'unpack it first (`zstd -d file`)'],
    ['gzip', Uint8Array.of(0x1f, 0x8b, 8), 'unpack it first (`gunzip file`)'],
    ['rosbag2’s SQLite', text('SQLite format 3\0 and more'), 'convert it to MCAP with `ros2 bag convert`'],
    ['an old bag', text('#ROSBAG V1.2\n'), '`rosbag fix`'],
    ['metadata.yaml', text('rosbag2_bagfile_information:\n'), 'name the .mcap file beside it'],
    ['PCD', text('# .PCD v0.7\n'), '--source pcd'],
    ['text', text('hello'), 'neither MCAP nor a ROS 1 bag'],
  ])('%s', async (_, bytes, words) => {
    const path = join(folder, 'file');
    writeFileSync(path, bytes);
    await expect(openRecording(path)).rejects.toMatchObject({ code: 'not-a-recording', offset: 0 });
    await expect(openRecording(path)).rejects.toThrow(`${path}: is `);
    await expect(openRecording(path)).rejects.toThrow(words);
  });

  it.each([
    [['metadata.yaml', 'run_0.mcap', 'run_1.mcap'], 'name one of the files in it: run_0.mcap, run_1.mcap'],
    [['metadata.yaml', 'run_0.mcap.zstd'], 'unpack it first (`zstd -d run_0.mcap.zstd`)'],
    [['metadata.yaml', 'run_0.db3'], '`ros2 bag convert`'],
    [[], 'is a folder without a recording'],
  ])('a folder with %j', async (names, words) => {
    const path = mkdtempSync(join(folder, 'bag-'));
    for (const name of names) writeFileSync(join(path, name), '');
    mkdirSync(join(path, 'more'));
    await expect(openRecording(path)).rejects.toThrow(words);
  });
});

it('a message that its schema does not allow is reported in words, not as a validator’s JSON', async () => {
  const messages = [{ logNs: 1n, data: text('{"header":{}}') }];
  const type = 'sensor_msgs/msg/PointCloud2';
  const path = join(folder, 'json.mcap');
  writeFileSync(path, await mcapOfTopics([{ topic: '/points', type, messageEncoding: 'json', messages }]));
  await expect(playClouds({ path })).rejects.toThrow(
    /\/points: byte \d+: header\.stamp: [^{}[\]]+, and \d+ more$/,
  );
});
