import { McapConstants } from '@mcap/core';
import { BagRecording } from './bag-recording.ts';
import { RecordingError } from './errors.ts';
import { FileBytes } from './file-bytes.ts';
import { foreignFile, foreignFolder, MARK_BYTES } from './foreign-file.ts';
import { IndexedMcap } from './mcap-indexed.ts';
import { ScannedMcap } from './mcap-scanned.ts';
import type { Recording } from './recording.ts';

const BAG_MAGIC = new TextEncoder().encode('#ROSBAG V2.0\n');

/**
 * Opens an MCAP file or a ROS 1 bag, identified by the first bytes. An MCAP file without its index, or with half of
 * one, as left by a killed recorder or by one that writes none, is read once from front to back.
 *
 * @throws {RecordingError} stating what cannot be read, and where
 */
export async function openRecording(path: string): Promise<Recording> {
  const folder = foreignFolder(path);
  if (folder !== null) throw folder;
  const bytes = await FileBytes.open(path);
  try {
    const head = await bytes.read(0, Math.min(bytes.size, MARK_BYTES));
    if (startsWith(head, BAG_MAGIC)) return await BagRecording.open(bytes);
    if (!startsWith(head, Uint8Array.from(McapConstants.MCAP_MAGIC))) {
      throw foreignFile(path, head);
    }
    try {
      return await IndexedMcap.open(bytes);
    } catch (error) {
      if (!(error instanceof RecordingError) || error.code === 'unreadable') throw error;
      return await ScannedMcap.open(bytes);
    }
  } catch (error) {
    await bytes.close();
    throw error;
  }
}

function startsWith(bytes: Uint8Array, magic: Uint8Array): boolean {
  return bytes.length >= magic.length && magic.every((byte, i) => bytes[i] === byte);
}
