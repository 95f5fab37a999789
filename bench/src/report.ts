/** How benchmarks present themselves and their results. */
import type { Distribution } from './stats.ts';

/** What `bench/src/<name>.ts` exports as `bench`. */
export interface Bench {
  name: string;
  /** One line for the list of benchmarks. */
  summary: string;
  /** What `--help` prints. */
  usage: string;
  /** Runs the benchmark with the arguments after its name. Throws an Error with a clear message if it cannot. */
  run(argv: string[]): Promise<void>;
}

export type Cell = string | number | null | undefined;

/** A table for people: each column as wide as its widest cell, with numbers to the right. */
export function formatTable(header: readonly string[], rows: readonly (readonly Cell[])[]): string {
  const text = rows.map((row) => row.map(formatCell));
  const numeric = header.map((_, c) => rows.every((row) => typeof row[c] !== 'string'));
  const widths = header.map((title, c) =>
    Math.max(title.length, ...text.map((row) => (row[c] ?? '').length)),
  );
  const line = (cells: readonly string[]) =>
    cells
      .map((cell, c) => (numeric[c] ? cell.padStart(widths[c] as number) : cell.padEnd(widths[c] as number)))
      .join('  ')
      .trimEnd();
  const rule = widths.map((width) => '-'.repeat(width)).join('  ');
  return [line(header), rule, ...text.map(line)].join('\n');
}

/** Prints {@link formatTable}. */
export function printTable(header: readonly string[], rows: readonly (readonly Cell[])[]): void {
  console.log(formatTable(header, rows));
}

/** The cells p50, p95, p99 and max of a distribution. */
export function distributionCells(values: Distribution): number[] {
  return [values.p50, values.p95, values.p99, values.max];
}

/** Prints one JSON object on its own line. Call this last, if `--json` is given. */
export function printJson(result: Record<string, unknown>): void {
  console.log(JSON.stringify(result));
}

function formatCell(cell: Cell): string {
  if (cell === null || cell === undefined) return '–';
  if (typeof cell === 'string') return cell;
  if (!Number.isFinite(cell)) return '–';
  if (Number.isInteger(cell)) return cell.toLocaleString('en-US');
  const magnitude = Math.abs(cell);
  return cell.toFixed(magnitude >= 100 ? 1 : magnitude >= 1 ? 2 : 4);
}
