export const RECORDED_CODINGS = ['h264', 'vp8'] as const;
export type RecordedCoding = (typeof RECORDED_CODINGS)[number];

/** A coded picture of a played video. */
export interface PlayedPicture {
  coding: RecordedCoding;
  /** H.264: an access unit as in Annex B; VP8: a frame. */
  bytes: Uint8Array<ArrayBuffer>;
  /** On the robot's clock, as if it were captured now, ms. */
  capturedAtMs: number;
}
