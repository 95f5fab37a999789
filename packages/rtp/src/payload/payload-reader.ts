import type { FrameBuffer } from './frame-buffer.ts';

/** Why a payload cannot become part of a frame. */
export type PayloadFault =
  | 'malformed' // breaks a rule of its format, or contradicts the payloads before it
  | 'too-large'; // the frame would be longer than allowed

/** What a whole frame turned out to be. */
export interface FrameKind {
  /** A decoder can begin with it. */
  isKeyFrame: boolean;
}

/** Turns the payloads of one format, in order and without gaps, into frames. Never throws. */
export interface PayloadReader {
  /** Forgets what is known of an unfinished frame. */
  reset(): void;
  /** Whether the payload can only be the first of a frame, or the frame can do without those that were before it. */
  beginsFrame(payload: Uint8Array): boolean;
  /** Appends what the payload holds; at least one byte long. */
  append(payload: Uint8Array, frame: FrameBuffer): PayloadFault | null;
  /** Judges the frame after its last payload; `null` if it is malformed. */
  finish(frame: Uint8Array): FrameKind | null;
}
