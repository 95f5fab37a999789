/** What the page and the picture worker say to each other. */
import type { PictureFormat } from '@farpoint/protocol';

export interface PictureToDecode {
  /** Comes back with the answer. */
  ticket: number;
  format: PictureFormat;
  width: number;
  height: number;
  bytes: Uint8Array<ArrayBuffer>;
}

export type FromPictureWorker = { ticket: number; bitmap: ImageBitmap } | { ticket: number; fault: string };
