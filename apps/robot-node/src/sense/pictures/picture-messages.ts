/** Messages about pictures between the capture thread, the picture thread and the main thread. */

import type { SourcePicture } from '@farpoint/cloud-source';
import type { PictureHeader } from '@farpoint/protocol';

/** How to make a camera's pictures. */
export interface CameraPlan {
  /** Highest number of pictures per second; 0 if nobody watches. */
  perSecond: number;
  /** Pixels. Larger pictures are shrunk by a whole factor. */
  longestSide: number;
  /** JPEG quality, 1–100. */
  quality: number;
  /** A file with more bytes, or with a longer side in pixels, is re-encoded. Others are passed on unchanged. */
  mostFileBytes: number;
  mostFileSide: number;
}

/** Why a picture was sent to nobody. */
export type PictureLoss =
  | 'busy' // the one before was still being made
  | 'unsupported' // an encoding or a format that nobody here reads
  | 'bad-image' // sizes that do not agree, or data that ends
  | 'unreadable' // a file that is broken
  | 'too-large'; // more pixels than are read, or more bytes than fit a picture's chunks

/** Capture thread to picture thread; `data` is transferred. */
export interface OfferedPicture extends Omit<SourcePicture, 'data'> {
  data: Uint8Array<ArrayBuffer>;
  /** Number of this camera's pictures dropped since the last one, because the picture thread was busy. */
  missed: number;
}

/** Picture thread to capture thread. */
export type TapReport =
  | { type: 'rates'; perSecond: readonly number[] }
  /** The last picture of this camera is done; returns its memory. */
  | { type: 'done'; camera: number; room: ArrayBuffer };

/** Main thread to picture thread. */
export type PictureRequest = { type: 'plans'; plans: readonly CameraPlan[] };

/** A picture, divided into the messages that carry it. */
export interface ReadyPicture {
  type: 'picture';
  header: PictureHeader;
  /** When it was taken, robot's clock, ms. The header's time wraps; this does not. */
  capturedAtMs: number;
  /** Size of the file. */
  fileBytes: number;
  chunks: Uint8Array<ArrayBuffer>[];
  /** The longest side that the plan asked for, and whether the source's own file was used unchanged. */
  longestSide: number;
  untouched: boolean;
  /** Processor time to make it, ms. */
  workMs: number;
}

export type PictureReport =
  | ReadyPicture
  | { type: 'lost'; camera: number; reason: PictureLoss; count: number; detail: string; origin?: string };
