/** A camera's picture as its source gives it, and the interface through which sources give pictures. */
import type { PictureFormat } from '@farpoint/protocol';

/** Raw pixels, as in sensor_msgs/Image. */
export interface RawPicture {
  kind: 'raw';
  width: number;
  height: number;
  /** Number of bytes from one row to the next. */
  step: number;
  /** An encoding from sensor_msgs/image_encodings. */
  encoding: string;
  bigEndian: boolean;
}

/** An image file. Its own header gives format and size. */
export interface PictureFileFacts {
  kind: 'file';
  format: PictureFormat;
  width: number;
  height: number;
}

export interface SourcePicture {
  /** Index in the source's list of cameras. */
  camera: number;
  /** When it was taken, robot's clock, ms. */
  capturedAtMs: number;
  facts: RawPicture | PictureFileFacts;
  /** Where it was read, for error messages; absent for a live camera. */
  origin?: string;
  /** Valid only during the call. */
  data: Uint8Array;
}

/** Takes pictures from a source. The source asks first, so that it need not even read pictures that nobody wants. */
export interface PictureTaker {
  /** Whether the picture of this camera that arrives now is wanted and should be offered. */
  wants(camera: number, nowMs: number): boolean;
  offer(picture: SourcePicture): void;
}
