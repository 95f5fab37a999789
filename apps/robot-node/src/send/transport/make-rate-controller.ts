import {
  AdaptiveRateController,
  FixedRateController,
  type RateController,
  ReportRateController,
} from '@farpoint/congestion';

export interface RateControlOptions {
  /** Highest rate of a stream on the wire, bit/s. */
  bitsPerSecond: number;
  /** How a stream's rate is set: `adaptive`, or `fixed` at the highest rate, halved on sustained loss. */
  rateControl: 'adaptive' | 'fixed';
  /** Initial rate of an adaptive stream, bit/s. */
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
