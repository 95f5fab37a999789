/** Times at which the link of a capacity trace carries nothing. */
import { readFileSync } from 'node:fs';
import { parseTrace } from '@farpoint/network-sim';
import { outagesOf } from './link-analysis.ts';

/** Seconds of the trace without service, in which nothing is returned either. */
export function traceOutages(path: string): { from: number; to: number }[] {
  const { steps } = parseTrace(readFileSync(path, 'utf8'));
  const capacities = steps.map(({ atMs, mbps }) => ({ timeMs: atMs, capacityMbps: mbps }));
  return outagesOf(capacities).map(({ fromMs, toMs }) => ({ from: fromMs / 1000, to: toMs / 1000 }));
}

export function downlinkOutages(spans: readonly { from: number; to: number }[]): string[] {
  return spans.length === 0 ? [] : ['--down-outages', spans.map(({ from, to }) => `${from}-${to}`).join(',')];
}
