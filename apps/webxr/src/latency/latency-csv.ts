/** The results of latency tests as a table of comma-separated values (RFC 4180). Pure. */
import type { LatencyEntry } from './latency-log.ts';
import { TEST_STAGES } from './test-stages.ts';

const HEAD = [
  ...['time', 'test', 'mtp_ms', 'first_ms', 'arrived_ms'],
  ...['command_ms', 'wait_ms', 'cloud_ms', 'draw_ms', 'points', 'total_points', 'failure'],
];

/** One row for each test. What is not known is empty. */
export function latencyCsv(entries: readonly LatencyEntry[]): string {
  const rows = entries.map(({ atMs, report, failure, stages }) => [
    new Date(atMs).toISOString(),
    report?.id,
    ...[report?.mtpMs, report?.firstMs, report?.arrivedMs].map(rounded),
    ...TEST_STAGES.map((stage) => rounded(stages?.[stage])),
    ...[report?.points, report?.totalPoints, failure],
  ]);
  return [HEAD, ...rows].map((row) => `${row.map((value) => value ?? '').join(',')}\r\n`).join('');
}

function rounded(ms: number | undefined): string | undefined {
  return ms?.toFixed(3);
}
