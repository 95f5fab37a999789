import { BitRate } from '@farpoint/timing';
import type { CodedFormat, DrawnMost } from './plan.ts';

/**
 * Clouds below this rate show nothing useful, so each sensor gets this much first, as far as the link allows, and
 * pictures get nothing on a path that has no more. It carries some 3,000 points at 10 frames/s with 16 bits each
 * (plan.ts).
 */
export const LEAST_CLOUD_BITS_PER_SECOND = BitRate.fromMbps(0.5);

/** The share of the path that the stream may use. */
export interface CaptureBudget {
  targetBitsPerSecond: number;
  /** Bytes that the transport adds to each payload. */
  overheadBytes: number;
  /** If nobody is watching, nothing is captured. */
  streaming: boolean;
  /** Somebody drives by what is captured: what delays a frame counts for more than its finest details. */
  prompt?: true;
  /** No operator watches: what is captured is for live viewers only, and is not sent. */
  unsent?: true;
  /**
   * The rate controller wants to probe the link: one frame, the next, should have at least this many bytes on the
   * wire. Each `clusterId` is one such request.
   */
  probe: { clusterId: number; bytes: number } | null;
  /** The most that those who decide can draw; left out if they draw all that comes. */
  display?: DrawnMost | undefined;
  /** Coded formats that may be used if they fit a frame. Each is read by at least one operator whose path decides. */
  coded: readonly CodedBudget[];
}

/** What frames in one coded format may use. */
export interface CodedBudget {
  format: CodedFormat;
  /** Bit rate for those operators that read this format and whose paths decide, bit/s. */
  targetBitsPerSecond: number;
  /** Bit rate in addition, for `points64` to those who do not read this format, bit/s; `null` if there are none. */
  plainBitsPerSecond: number | null;
}

/** The budget when only live viewers watch: clouds are captured at a low rate, and coded as little as possible. */
export const UNSENT_BUDGET: CaptureBudget = {
  targetBitsPerSecond: 1_000_000,
  overheadBytes: 0,
  streaming: true,
  unsent: true,
  probe: null,
  coded: [],
};

/** The budget when nobody is watching. */
export const NO_BUDGET: CaptureBudget = {
  targetBitsPerSecond: 0,
  overheadBytes: 0,
  streaming: false,
  probe: null,
  coded: [],
};
