/** Images of sensor_msgs as the raw pictures that the video process takes. */
import { type Image, pictureRows, RosFault } from '@farpoint/ros';
import type { RawFormat, RawFrame } from '@farpoint/video';

/** The video process takes no longer side. */
const MOST_SIDE = 8192;

/** Encodings whose bytes GStreamer reads as they are, and their bytes per pixel. */
const SAME: ReadonlyMap<string, readonly [RawFormat, number]> = new Map([
  ['rgb8', ['rgb', 3]],
  ['bgr8', ['bgr', 3]],
  ['8UC3', ['bgr', 3]],
  ['rgba8', ['rgba', 4]],
  ['bgra8', ['bgra', 4]],
  ['8UC4', ['bgra', 4]],
  ['mono8', ['gray', 1]],
  ['8UC1', ['gray', 1]],
  ['yuv422', ['uyvy', 2]],
  ['uyvy', ['uyvy', 2]],
  ['yuv422_yuy2', ['yuy2', 2]],
  ['yuyv', ['yuy2', 2]],
]);
/** Of a pixel. */
const RGBA_BYTES = 4;

/**
 * @param room gives memory for the picture; the image's own is valid only during the call
 * @throws {RosFault} `bad-image`, `unsupported`, `too-large`
 */
export function imageFrame(image: Image, captureNs: bigint, room: (bytes: number) => Uint8Array): RawFrame {
  const { width, height, step, encoding, data } = image;
  // Checks the sizes, too.
  const rows = pictureRows(image);
  if (Math.max(width, height) > MOST_SIDE)
    throw new RosFault('too-large', `${width} × ${height} pixels, at most ${MOST_SIDE} a side`);
  const [format, pixelBytes] = SAME.get(encoding) ?? (['rgba', RGBA_BYTES] as const);
  const stride = width * pixelBytes;
  const bytes = room(stride * height);
  if (!SAME.has(encoding)) {
    for (let row = 0; row < height; row++)
      rows.readRow(row, bytes.subarray(row * stride, (row + 1) * stride));
  } else if (step === stride) {
    bytes.set(data.subarray(0, bytes.length));
  } else {
    for (let row = 0; row < height; row++)
      bytes.set(data.subarray(row * step, row * step + stride), row * stride);
  }
  return { captureNs, format, width, height, stride, bytes };
}
