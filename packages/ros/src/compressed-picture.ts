/** CompressedImage of sensor_msgs, or of Foxglove: identified by the first bytes of its data. */
import { MAX_PICTURE_SIDE, type PictureFile, readPictureFile } from '@farpoint/protocol';
import { RosFault } from './fault.ts';
import type { CompressedImage } from './messages.ts';

/** compressed_depth_image_transport marks its images with this: a PNG with its own header, or another encoding. */
const DEPTH = 'compressedDepth';

/**
 * @returns format and size, from the file's header
 * @throws {RosFault} `unsupported`, `bad-image`, `too-large`
 */
export function compressedPicture({ format, data }: Pick<CompressedImage, 'format' | 'data'>): PictureFile {
  if (format.includes(DEPTH)) {
    throw new RosFault('unsupported', `a picture as ${DEPTH}`, {
      remedy: 'name the topic of the raw depth image',
    });
  }
  const file = readPictureFile(data);
  if (file === 'truncated') {
    throw new RosFault('bad-image', 'the picture ends before its size', {
      offset: data.length,
    });
  }
  if (file === 'unknown-format') {
    throw new RosFault(
      'unsupported',
      `a compressed picture (${format.slice(0, 64) || 'no format'}) that is neither JPEG nor PNG`,
    );
  }
  const { width, height } = file;
  if (Math.min(width, height) === 0) throw new RosFault('bad-image', `${width} × ${height} pixels`);
  if (Math.max(width, height) > MAX_PICTURE_SIDE)
    throw new RosFault('too-large', `${width} × ${height} pixels, at most ${MAX_PICTURE_SIDE} a side`);
  return file;
}
