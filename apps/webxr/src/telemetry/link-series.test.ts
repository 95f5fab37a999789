import { expect, test } from 'vitest';
import { LINK, linkSamples } from './link-series.ts';

const stages = { frames: 9, framesSeen: 40, firstPacketMs: 30, furtherPacketsMs: 5, drawMs: 12, totalMs: 47 };
const stats = { frameStages: stages, rttMs: 6, lossRate: 0.025, bitsPerSecond: 8_000_000 };

test('the link’s figures of now', () => {
  const samples = linkSamples(stats, 30).map(([{ label }, value]) => [label, value]);
  expect(samples).toEqual([
    ['Cloud latency', 47],
    ['Robot and network', 30],
    ['Further packets', 5],
    ['Decoding and drawing', 12],
    ['Round trip', 6],
    ['Loss', 2.5],
    ['Rate', 8],
  ]);
});

test('nothing is recorded of what is not known or no longer comes', () => {
  const keys = (framesSeen: number) =>
    linkSamples({ ...stats, rttMs: null }, framesSeen).map(([{ key }]) => key);
  expect(keys(40)).toEqual([LINK.loss.key, LINK.rate.key]);
  expect(linkSamples({ ...stats, frameStages: null }, 0).map(([{ key }]) => key)).not.toContain(LINK.age.key);
});
