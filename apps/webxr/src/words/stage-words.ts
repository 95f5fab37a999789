/** Words and tables about where the time goes, of clouds and of commands. */
import type { Distribution, FrameStage, StageRow, StageSummary } from '@farpoint/operator';
import { ms } from './facts.ts';
import { texts } from './language.ts';
import { fixed } from './numbers.ts';

/**
 * Of all clouds in one line: how late they are, and the stage that takes longest, e.g. `240 ms · link 180 ms`.
 *
 * @returns `null` if there are none
 */
export function stageLine({ rows, totalMs, stages, worst }: StageSummary<FrameStage>): string | null {
  if (rows === 0) return null;
  const total = totalMs === null ? texts().timing.ageUnknown : ms(totalMs.p50);
  // Without the link's, what takes longest may be what is not known.
  if (worst === null || stages.link === null) return total;
  return `${total} · ${texts().timing.frameStages[worst]} ${ms(stages[worst]?.p50)}`;
}

export interface StageLineWords {
  readonly name: string;
  readonly median: string;
  readonly p95: string;
  /** Its median's share of all that are known, 0–1. */
  readonly share: number;
  /** Whether it takes longest. */
  readonly isWorst: boolean;
}

/** A line for each stage. What is not known is a dash, not 0. */
export function stageLines<Stage extends string>(
  { stages, worst }: StageSummary<Stage>,
  names: Readonly<Record<Stage, string>>,
): StageLineWords[] {
  const keys = Object.keys(names) as Stage[];
  const medianOf = (stage: Stage) => Math.max(0, stages[stage]?.p50 ?? 0);
  const all = keys.reduce((sum, stage) => sum + medianOf(stage), 0);
  return keys.map((stage) => ({
    name: names[stage],
    median: shortMs(stages[stage]?.p50),
    p95: shortMs(stages[stage]?.p95),
    share: all === 0 ? 0 : medianOf(stage) / all,
    isWorst: stage === worst,
  }));
}

/** From the beginning to the end. */
export function totalWords(what: string, totalMs: Distribution | null): string {
  if (totalMs === null) return `${what}: ${ms(null)}`;
  return texts().timing.total(what, shortMs(totalMs.p50), shortMs(totalMs.p95));
}

/** Why something is not known; empty if all is. */
export function unknownWords({ rows, untold, clockless }: StageSummary<string>): string {
  const said = texts().timing;
  if (clockless > 0) return said.clockUnknown;
  if (untold === 0) return '';
  return untold >= rows ? said.noneTold : said.allButTold(untold, rows);
}

/** To tenths where a whole number would read 0. */
function shortMs(value: number | null | undefined): string {
  return value === null || value === undefined || Math.abs(value) >= 10 ? ms(value) : `${fixed(value, 1)} ms`;
}

/**
 * The rows as comma-separated values (RFC 4180), one line for each. What is not known is empty.
 *
 * @param stages in the order of their columns
 * @param originMs the zero of the rows' clock, ms since the epoch
 */
export function stagesCsv<Stage extends string>(
  stages: readonly Stage[],
  rows: readonly StageRow<Stage>[],
  originMs: number,
): string {
  const head = ['time', 'number', 'total_ms', ...stages.map((stage) => `${stage}_ms`)];
  const lines = rows.map(({ number, endedMs, totalMs, stages: took }) => [
    new Date(originMs + endedMs).toISOString(),
    String(number),
    ...[totalMs, ...stages.map((stage) => took[stage])].map((value) => value?.toFixed(3) ?? ''),
  ]);
  return [head, ...lines].map((line) => `${line.join(',')}\r\n`).join('');
}
