/** What is recorded over time of the link and of the clouds' latency. Pure. */
import type { StreamStats } from '@farpoint/operator';
import { BitRate } from '@farpoint/timing';
import type { SeriesDescription } from './series-description.ts';

/** By which it is recorded. */
export const LINK = {
  age: { key: 'link age', label: 'Cloud latency', unit: 'ms' },
  first: { key: 'link first', label: 'Robot and network', unit: 'ms' },
  further: { key: 'link further', label: 'Further packets', unit: 'ms' },
  draw: { key: 'link draw', label: 'Decoding and drawing', unit: 'ms' },
  roundTrip: { key: 'link round trip', label: 'Round trip', unit: 'ms' },
  loss: { key: 'link loss', label: 'Loss', unit: '%' },
  rate: { key: 'link rate', label: 'Rate', unit: 'Mbit/s' },
} as const satisfies Record<string, SeriesDescription>;

/** Time between two samples, ms. */
export const LINK_EVERY_MS = 250;

export type LinkStats = Pick<StreamStats, 'frameStages' | 'rttMs' | 'lossRate' | 'bitsPerSecond'>;

/**
 * The values of now. A latency counts only if frames have come since the sample before: the mean of earlier ones says
 * nothing about now.
 *
 * @param framesSeen at the sample before
 */
export function linkSamples(
  { frameStages, rttMs, lossRate, bitsPerSecond }: LinkStats,
  framesSeen: number,
): readonly (readonly [SeriesDescription, number])[] {
  const stages = frameStages !== null && frameStages.framesSeen !== framesSeen ? frameStages : null;
  return [
    ...(stages === null
      ? []
      : [
          [LINK.age, stages.totalMs] as const,
          [LINK.first, stages.firstPacketMs] as const,
          [LINK.further, stages.furtherPacketsMs] as const,
          [LINK.draw, stages.drawMs] as const,
        ]),
    ...(rttMs === null ? [] : [[LINK.roundTrip, rttMs] as const]),
    [LINK.loss, lossRate * 100],
    [LINK.rate, BitRate.toMbps(bitsPerSecond)],
  ];
}
