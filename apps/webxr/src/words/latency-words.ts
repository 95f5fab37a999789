/** Words and a table about latency tests: motion to photon. */
import type { Distribution, LatencyFailure, LatencyReport } from '@farpoint/operator';
import { ms } from './facts.ts';

/** A test that ended, with a result or without. */
export interface LatencyTestEnd {
  /** When it ended, ms since the epoch. */
  readonly atMs: number;
  /** `null`: it failed. */
  readonly report: LatencyReport | null;
  readonly failure: LatencyFailure | null;
}

const failureWords: Readonly<Record<LatencyFailure, string>> = {
  timeout: 'no green cloud arrived',
  'no-session': 'connect to a robot first',
  'no-lease': 'only the driver can test',
  busy: 'another test is running',
};

/** What became of the last test. */
export function lastTestWords(end: LatencyTestEnd | undefined): string {
  if (end === undefined) return 'Motion to photon: not measured yet';
  const { report, failure } = end;
  if (report === null) return `Motion to photon: ${failure === null ? 'failed' : failureWords[failure]}`;
  return `Motion to photon: ${ms(report.mtpMs)}, first points ${ms(report.firstMs)}`;
}

/** How the results are distributed, and how many tests failed; empty before the first test. */
export function testsWords(ends: readonly LatencyTestEnd[], distribution: Distribution | null): string {
  if (ends.length === 0) return '';
  const failed = ends.filter(({ report }) => report === null).length;
  const failures = failed === 0 ? '' : `, ${failed} failed`;
  const count = `Last ${ends.length} test${ends.length === 1 ? '' : 's'}${failures}`;
  if (distribution === null) return count;
  return `${count}: median ${ms(distribution.p50)}, 95 of 100 within ${ms(distribution.p95)}`;
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
