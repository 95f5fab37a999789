/** A camera's picture as its source has it, and how sources come to give them. */
import type { PictureFormat } from '@farpoint/protocol';

/** Pixels, as sensor_msgs/Image has them. */
export interface RawPicture {
  kind: 'raw';
  width: number;
  height: number;
  /** Bytes from one row to the next. */
  step: number;
  /** Of sensor_msgs/image_encodings. */
  encoding: string;
  bigEndian: boolean;
}

/** A file; its own header gives format and size. */
export interface PictureFileFacts {
  kind: 'file';
  format: PictureFormat;
  width: number;
  height: number;
}

export interface SourcePicture {
  /** Place in the source's list of cameras. */
  camera: number;
  /** Robot's clock when it was taken, ms. */
  capturedAtMs: number;
  facts: RawPicture | PictureFileFacts;
  /** Where it was read, for messages of what is wrong with it; of a live camera left out. */
  origin?: string;
  /** Good only during the call. */
  data: Uint8Array;
}

/** Takes pictures from a source that is asked first: what nobody wants need not even be read. */
export interface PictureTaker {
  /** Whether the picture of this camera that comes now is wanted; it is then to be offered. */
  wants(camera: number, nowMs: number): boolean;
  offer(picture: SourcePicture): void;
}
