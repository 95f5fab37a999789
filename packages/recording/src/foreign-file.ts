/** What a file or a folder is that is no recording which can be played, and what to do about it. */
import { type Dirent, readdirSync } from 'node:fs';
import { basename } from 'node:path';
import { RecordingError } from './errors.ts';

/** Long enough for each of the marks below. */
export const MARK_BYTES = 16;

const COMPRESSED: readonly [mark: readonly number[], program: string][] = [
  [[0x28, 0xb5, 0x2f, 0xfd], 'zstd -d'],
  [[0x1f, 0x8b], 'gunzip'],
  [[0x04, 0x22, 0x4d, 0x18], 'lz4 -d'],
  [[0xfd, 0x37, 0x7a, 0x58, 0x5a], 'unxz'],
  [[0x42, 0x5a, 0x68], 'bunzip2'],
  [[0x50, 0x4b, 0x03, 0x04], 'unzip'],
];
const TEXTS: readonly [mark: string, detail: string][] = [
  [
    'SQLite format 3',
    'is SQLite, as older versions of rosbag2 record: convert it to MCAP with `ros2 bag convert`',
  ],
  ['#ROSBAG V1', 'is a ROS 1 bag of an old version: convert it with `rosbag fix`'],
  ['rosbag2_bagfile', 'is the description of a rosbag2 recording: name the .mcap file beside it'],
  ['# .PCD', 'is a PCD file: play it with --source pcd'],
];

/** @param head the first bytes of the file */
export function foreignFile(path: string, head: Uint8Array): RecordingError {
  const fault = (detail: string) => new RecordingError('not-a-recording', detail, { file: path, offset: 0 });
  if (head.length === 0) return fault('is empty');
  const packed = COMPRESSED.find(([mark]) => mark.every((byte, i) => head[i] === byte));
  if (packed !== undefined)
    return fault(`is compressed as a whole: unpack it first (\`${packed[1]} ${basename(path)}\`)`);
  const text = new TextDecoder('latin1').decode(head);
  const known = TEXTS.find(([mark]) => text.startsWith(mark));
  return fault(known?.[1] ?? 'is neither MCAP nor a ROS 1 bag of version 2.0');
}

/** Says which file of a folder can be played; `null` if it is no folder that can be read. */
export function foreignFolder(path: string): RecordingError | null {
  let entries: Dirent[];
  try {
    entries = readdirSync(path, { withFileTypes: true });
  } catch {
    return null;
  }
  const names = entries.map(({ name }) => name).sort();
  const having = (...ends: string[]) => names.filter((name) => ends.some((end) => name.endsWith(end)));
  const [playable, packed, databases] = [
    having('.mcap', '.bag'),
    having('.mcap.zstd', '.mcap.zst'),
    having('.db3', '.db3.zstd'),
  ];
  const detail =
    playable.length > 0
      ? `is a folder: name ${playable.length === 1 ? 'the file' : 'one of the files'} in it: ${playable.slice(0, 5).join(', ')}`
      : packed.length > 0
        ? `is a folder whose recording is compressed as a whole: unpack it first (\`zstd -d ${packed[0]}\`)`
        : databases.length > 0
          ? 'is a folder of rosbag2 with SQLite: convert it to MCAP with `ros2 bag convert`'
          : 'is a folder without a recording';
  return new RecordingError('not-a-recording', detail, { file: path });
}
