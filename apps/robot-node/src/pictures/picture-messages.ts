/** What the capture thread, the picture thread and the main thread say to each other of pictures. */
import type { PictureHeader } from '@farpoint/protocol';
import type { SourcePicture } from './source-picture.ts';

/** What is to be made of a camera's pictures now. */
export interface CameraPlan {
  /** At most so many a second; 0 where nobody watches. */
  perSecond: number;
  /** Pixels; larger ones are shrunk by a whole factor. */
  longestSide: number;
  /** Of JPEG, 1–100. */
  quality: number;
  /** A file that is larger, in bytes or pixels of a side, is made anew; others go on as they are. */
  mostFileBytes: number;
  mostFileSide: number;
}

/** Why a picture was not sent to anybody. */
export type PictureLoss =
  | 'busy' // the one before was still being made
  | 'unsupported' // an encoding or a format that nobody here reads
  | 'bad-image' // sizes that do not agree, or data that ends
  | 'unreadable' // a file that is broken
  | 'too-large'; // more pixels than are read, or more bytes than fit a picture's chunks

/** Capture thread to picture thread; `data` is transferred. */
export interface OfferedPicture extends Omit<SourcePicture, 'data'> {
  data: Uint8Array<ArrayBuffer>;
  /** Pictures of this camera that were let go since the last one: it was busy. */
  missed: number;
}

/** Picture thread to capture thread. */
export type TapReport =
  | { type: 'rates'; perSecond: readonly number[] }
  /** The last picture of this camera is done; its memory comes back. */
  | { type: 'done'; camera: number; room: ArrayBuffer };

/** Main thread to picture thread. */
export type PictureRequest = { type: 'plans'; plans: readonly CameraPlan[] };

/** A picture, cut into the messages that carry it. */
export interface ReadyPicture {
  type: 'picture';
  header: PictureHeader;
  /** Robot's clock when it was taken, ms: the header's wraps. */
  capturedAtMs: number;
  /** Of the file. */
  fileBytes: number;
  chunks: Uint8Array<ArrayBuffer>[];
  /** Longest side that the plan asked for, and whether the source's own file was taken as it is. */
  longestSide: number;
  untouched: boolean;
  /** Processor time that it took, ms. */
  workMs: number;
}

export type PictureReport =
  | ReadyPicture
  | { type: 'lost'; camera: number; reason: PictureLoss; count: number; detail: string; origin?: string };
