/** Messages between the page and the picture worker. */
import type { PictureFormat } from '@farpoint/protocol';

export interface PictureToDecode {
  /** Identifies the request; repeated in the answer. */
  ticket: number;
  format: PictureFormat;
  width: number;
  height: number;
  bytes: Uint8Array<ArrayBuffer>;
}

export type FromPictureWorker = { ticket: number; bitmap: ImageBitmap } | { ticket: number; fault: string };
