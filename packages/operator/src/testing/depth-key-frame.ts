/** A key frame from a depth picture, as the worker's decoder and the page would make it. */
import type { CameraIntrinsics, Pose } from '@farpoint/protocol';
import { KEY_FRAME_BYTES, KeyFrame } from '../memory/key-frame.ts';

export interface DepthPicture {
  intrinsics: Readonly<CameraIntrinsics>;
  cameraPose: Pose;
  /** Along z, metres; 0 where nothing was seen. */
  depth: Float32Array;
  /** R, G, B, 255. */
  colour: Uint8Array;
}

/**
 * @param stride one of so many rows and columns is taken
 * @param nowMs when it was captured and arrived, milliseconds since the memory began
 * @param into a frame to fill; default: a new one
 */
export function depthKeyFrame(
  { intrinsics, cameraPose: { position, orientation }, depth, colour }: DepthPicture,
  stride: number,
  nowMs: number,
  into = new KeyFrame(new ArrayBuffer(KEY_FRAME_BYTES)),
): KeyFrame {
  into.samples = 0;
  into.isTiles = true;
  into.sensor = 0;
  into.arrivedMs = nowMs;
  into.capturedUs = (nowMs * 1000) % 2 ** 32;
  const pose = [
    position.x,
    position.y,
    position.z,
    orientation.x,
    orientation.y,
    orientation.z,
    orientation.w,
  ];
  for (const [i, value] of pose.entries()) into.setPose(i, value);
  into.setLens(intrinsics);
  const { width, height } = intrinsics;
  for (let v = 0; v < height; v += stride) {
    for (let u = 0; u < width; u += stride) {
      const at = v * width + u;
      const z = depth[at] as number;
      if (!(z > 0)) continue;
      const [red, green, blue] = [colour[at * 4], colour[at * 4 + 1], colour[at * 4 + 2]] as [
        number,
        number,
        number,
      ];
      const rgb = ((red >> 3) << 11) | ((green >> 2) << 5) | (blue >> 3);
      into.addPixel(u, v, halfOf(1 / z) + rgb * 0x10000);
    }
  }
  return into;
}

/** The bits of a half float. @param value from 2⁻¹⁴ to 65,504 */
export function halfOf(value: number): number {
  const exponent = Math.floor(Math.log2(value));
  return Math.round((value / 2 ** exponent - 1) * 1024) + ((exponent + 15) << 10);
}
