import type { CodedFormat } from './plan.ts';

/** What the stream may take. */
export interface CaptureBudget {
  targetBitsPerSecond: number;
  /** Bytes that the transport adds to each payload. */
  overheadBytes: number;
  /** With nobody watching nothing is captured. */
  streaming: boolean;
  /**
   * The rate control wants to try the link: one frame, the next, is to have at least so many bytes on the wire. Each
   * `clusterId` is one such wish.
   */
  probe: { clusterId: number; bytes: number } | null;
  /** The coded formats that may be used, where they fit a frame: each is read by somebody who decides. */
  coded: readonly CodedBudget[];
}

/** What frames in one coded format may take. */
export interface CodedBudget {
  format: CodedFormat;
  /** Of those who decide and read it, bit/s. */
  targetBitsPerSecond: number;
  /** Beside them: what those may be sent who do not read it, as `points64`, bit/s; `null` where there are none. */
  plainBitsPerSecond: number | null;
}

/** Nobody watches. */
export const NO_BUDGET: CaptureBudget = {
  targetBitsPerSecond: 0,
  overheadBytes: 0,
  streaming: false,
  probe: null,
  coded: [],
};
