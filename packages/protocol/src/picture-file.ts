/**
 * Identifies a picture file by its first bytes, before anything decodes it.
 *
 * Sources: ITU-T T.81 (JPEG), B.1.1.3 and B.2.2; ISO/IEC 15948 (PNG), 5.2 and 11.2.2.
 */
import type { PictureFormat } from './picture-chunk.ts';

export interface PictureFile {
  format: PictureFormat;
  /** Pixels, as stated in the header; 0 is possible. */
  width: number;
  height: number;
}

/** Why a file's header cannot be read. */
export type PictureFileFault =
  | 'unknown-format' // neither JPEG nor PNG
  | 'truncated'; // it ends before the header states the size

const PNG_MAGIC = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const PNG_IHDR = [0x49, 0x48, 0x44, 0x52];
const JPEG_SOI = [0xff, 0xd8, 0xff];

export function readPictureFile(bytes: Uint8Array): PictureFile | PictureFileFault {
  if (begins(bytes, 0, JPEG_SOI)) return readJpeg(bytes);
  if (!begins(bytes, 0, PNG_MAGIC)) return 'unknown-format';
  if (bytes.length < 24) return 'truncated';
  if (!begins(bytes, 12, PNG_IHDR)) return 'unknown-format';
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  return { format: 'png', width: view.getUint32(16), height: view.getUint32(20) };
}

/** Walks through the segments to the frame header. */
function readJpeg(bytes: Uint8Array): PictureFile | PictureFileFault {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 2;
  while (at + 4 <= bytes.length) {
    if (bytes[at] !== 0xff) return 'unknown-format';
    const marker = bytes[at + 1] as number;
    if (marker === 0xff) {
      // Fill bytes may precede a marker.
      at++;
      continue;
    }
    const alone = marker === 0x01 || (marker >= 0xd0 && marker <= 0xd8);
    if (alone) {
      at += 2;
      continue;
    }
    // The scan data begins, or the file ends, without a frame header.
    if (marker === 0xda || marker === 0xd9 || marker === 0x00) return 'unknown-format';
    const length = view.getUint16(at + 2);
    if (length < 2) return 'unknown-format';
    if (isFrameHeader(marker)) {
      if (at + 9 > bytes.length) return 'truncated';
      return { format: 'jpeg', width: view.getUint16(at + 7), height: view.getUint16(at + 5) };
    }
    at += 2 + length;
  }
  return 'truncated';
}

/** SOF0 to SOF15, except DHT, JPG and DAC, which lie between them. */
function isFrameHeader(marker: number): boolean {
  return marker >= 0xc0 && marker <= 0xcf && marker !== 0xc4 && marker !== 0xc8 && marker !== 0xcc;
}

function begins(bytes: Uint8Array, at: number, magic: readonly number[]): boolean {
  return magic.every((value, i) => bytes[at + i] === value);
}
