/** Options that describe capacities over time. */
import type { CapacityStep, Outage } from '@farpoint/network-sim';
import * as z from 'zod';

/** `10-15,30-36`: time spans in seconds, ascending. */
export const outages = z.preprocess(
  (value) => (typeof value === 'number' ? String(value) : value),
  z.string('must be text').transform((text, context): Outage[] => {
    const list = text.split(',').map((part) => /^\s*(\d+(?:\.\d+)?)-(\d+(?:\.\d+)?)\s*$/.exec(part));
    const read = list.map((match) => ({
      startMs: Number(match?.[1]) * 1000,
      endMs: Number(match?.[2]) * 1000,
    }));
    const rising = read.every(
      ({ startMs, endMs }, i) => startMs < endMs && (i === 0 || startMs >= read[i - 1]!.endMs),
    );
    if (rising) return read;
    context.addIssue({
      code: 'custom',
      message: 'must be spans of seconds one after the other, e.g. 10-15,30-36',
    });
    return z.NEVER;
  }),
) as z.ZodType<Outage[]>;

/** `0:41.44,30:8`: seconds and Mbit/s, ascending from 0. */
export const steps = z.string('must be text').transform((text, context): CapacityStep[] => {
  const list = text.split(',').map((part) => /^\s*(\d+(?:\.\d+)?):(\d+(?:\.\d+)?)\s*$/.exec(part));
  const read = list.map((match) => ({ atMs: Number(match?.[1]) * 1000, mbps: Number(match?.[2]) }));
  if (read[0]?.atMs === 0 && read.every(({ atMs }, i) => i === 0 || atMs > read[i - 1]!.atMs)) return read;
  context.addIssue({
    code: 'custom',
    message: 'must be SECONDS:MBPS from second 0 on, e.g. 0:41.44,30:8,60:41.44',
  });
  return z.NEVER;
});
