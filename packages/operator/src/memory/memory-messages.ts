/** Messages between the page and the memory's worker. Buffers are transferred. */
import type { PointFileFormat } from './point-file.ts';
import type { MotionLimits } from './pose-jump.ts';
import type { TopViewArea } from './top-view.ts';

export type ToMemoryWorker =
  /** A key frame (key-frame.ts). */
  | { type: 'frame'; buffer: ArrayBuffer }
  /** A buffer for pages, of an earlier message, for reuse. */
  | { type: 'return'; buffer: ArrayBuffer }
  | { type: 'forget' }
  /** What a robot can drive; what goes beyond it is a jump of its localisation. */
  | { type: 'limits'; limits: MotionLimits }
  /** Look at what is remembered from above (top-view.ts). */
  | { type: 'topView'; buffer: ArrayBuffer; area: TopViewArea; nowMs: number }
  /** Hand on everything again. */
  | { type: 'resend' }
  /** Write everything to a file. */
  | { type: 'save'; ticket: number; nowMs: number; savedAt: string; format: PointFileFormat }
  /** Remember what is in a PLY or PCD file, as seen so long ago. */
  | { type: 'load'; ticket: number; nowMs: number; agoS: number; bytes: ArrayBuffer };

export type FromMemoryWorker =
  /** Changed pages (memory-pages.ts). */
  | { type: 'pages'; buffer: ArrayBuffer; count: number }
  /** Everything was forgotten: pages of later messages are all there is. */
  | { type: 'forgotten'; jumped: boolean }
  /** A key frame was taken; its buffer is free again. */
  | { type: 'taken'; buffer: ArrayBuffer; stats: MemoryStats }
  /** Where its first cell is, metres, and how long ago the oldest of it was seen. */
  | { type: 'topView'; buffer: ArrayBuffer; x: number; y: number; oldestS: number | null }
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
