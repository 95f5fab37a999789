/** Words and a table about latency tests: motion to photon. */
import type { Distribution, LatencyFailure, LatencyReport } from '@farpoint/operator';
import { ms } from './facts.ts';
import { texts } from './language.ts';

/** A test that ended, with a result or without. */
export interface LatencyTestEnd {
  /** When it ended, ms since the epoch. */
  readonly atMs: number;
  /** `null`: it failed. */
  readonly report: LatencyReport | null;
  readonly failure: LatencyFailure | null;
}

/** What became of the last test. */
export function lastTestWords(end: LatencyTestEnd | undefined): string {
  const said = texts().timing;
  if (end === undefined) return said.notMeasured;
  const { report, failure } = end;
  if (report === null) return said.lastFailed(failure === null ? said.failed : said.failures[failure]);
  return said.last(ms(report.mtpMs), ms(report.firstMs));
}

/** How the results are distributed, and how many tests failed; empty before the first test. */
export function testsWords(ends: readonly LatencyTestEnd[], distribution: Distribution | null): string {
  if (ends.length === 0) return '';
  const said = texts().timing;
  const failed = ends.filter(({ report }) => report === null).length;
  const tests = said.tests(ends.length);
  const count = failed === 0 ? tests : said.testsFailed(tests, failed);
  if (distribution === null) return count;
  return said.testsTook(count, ms(distribution.p50), ms(distribution.p95));
}

const HEAD = ['time', 'test', 'mtp_ms', 'first_ms', 'arrived_ms', 'points', 'total_points', 'failure'];

/**
 * The tests as comma-separated values (RFC 4180), one line for each, and the percentiles of the results below them. What is not
 * known is empty.
 */
export function latencyCsv(ends: readonly LatencyTestEnd[], distribution: Distribution | null): string {
  const rows = ends.map(({ atMs, report, failure }) => [
    new Date(atMs).toISOString(),
    report?.id,
    ...[report?.mtpMs, report?.firstMs, report?.arrivedMs].map(rounded),
    report?.points,
    report?.totalPoints,
    failure,
  ]);
  const figures = (['p50', 'p95'] as const).map((name) => [
    name,
    '',
    rounded(distribution?.[name]),
    ...HEAD.slice(3).map(() => ''),
  ]);
  return [HEAD, ...rows, ...figures]
    .map((row) => `${row.map((value) => value ?? '').join(',')}\r\n`)
    .join('');
}

function rounded(value: number | undefined): string | undefined {
  return value?.toFixed(3);
}
