import {
  AdaptiveRateController,
  FixedRateController,
  type RateController,
  ReportRateController,
} from '@farpoint/congestion';

export interface RateControlOptions {
  /** The most a stream may take on the wire, bit/s. */
  bitsPerSecond: number;
  /** How the rate of a stream is found: `adaptive`, or always the most, halved on sustained loss. */
  rateControl: 'adaptive' | 'fixed';
  /** What an adaptive rate begins with, bit/s. */
  startBitsPerSecond: number;
}

/** @param transportFeedback whether the peer gives transport-wide feedback */
export function makeRateController(
  { bitsPerSecond, rateControl, startBitsPerSecond }: RateControlOptions,
  transportFeedback: boolean,
): RateController {
  if (rateControl === 'fixed') return new FixedRateController({ bitsPerSecond });
  const options = {
    startBitsPerSecond: Math.min(startBitsPerSecond, bitsPerSecond),
    maxBitsPerSecond: bitsPerSecond,
  };
  return transportFeedback ? new AdaptiveRateController(options) : new ReportRateController(options);
}
