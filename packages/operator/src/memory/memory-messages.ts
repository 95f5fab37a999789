/** Messages between the page and the memory's worker. Buffers are transferred. */
import type { MotionLimits } from './pose-jump.ts';

export type ToMemoryWorker =
  /** A key frame (key-frame.ts). */
  | { type: 'frame'; buffer: ArrayBuffer }
  /** A buffer for pages, of an earlier message, for reuse. */
  | { type: 'return'; buffer: ArrayBuffer }
  | { type: 'forget' }
  /** What a robot can drive; what goes beyond it is a jump of its localisation. */
  | { type: 'limits'; limits: MotionLimits }
  /** Hand on everything again. */
  | { type: 'resend' }
  /** Write everything as PLY. @see MemoryFile */
  | { type: 'save'; ticket: number; nowMs: number; savedAt: string }
  /** Remember what is in a PLY file, as seen so long ago. */
  | { type: 'load'; ticket: number; nowMs: number; agoS: number; bytes: ArrayBuffer };

export type FromMemoryWorker =
  /** Changed pages (memory-pages.ts). */
  | { type: 'pages'; buffer: ArrayBuffer; count: number }
  /** Everything was forgotten: pages of later messages are all there is. */
  | { type: 'forgotten'; jumped: boolean }
  /** A key frame was taken; its buffer is free again. */
  | { type: 'taken'; buffer: ArrayBuffer; stats: MemoryStats }
  | { type: 'saved'; ticket: number; bytes: ArrayBuffer }
  | { type: 'loaded'; ticket: number; points: number }
  | { type: 'refused'; ticket: number; message: string };

/** Figures of a memory. */
export interface MemoryStats {
  /** Surfels, including those that are not confirmed yet. */
  surfels: number;
  /** Bytes of the memory, used or not. */
  bytes: number;
  /** Duration of the last frame's work in the worker, ms. */
  busyMs: number;
}
