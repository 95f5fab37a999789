/** Words about where the time goes between the robot's camera, the operator's eyes and hands. */
import type { FrameStages, LatencyFailure, LatencyReport } from '@farpoint/operator';
import type { CloudStages } from '../latency/cloud-stages.ts';
import type { LatencyEntry } from '../latency/latency-log.ts';
import type { TestStages } from '../latency/test-stages.ts';
import { ms, NO_FIGURE } from './facts.ts';

/** A part of a bar. */
export interface StageWords {
  readonly name: string;
  /** `null` if it is not known. */
  readonly ms: number | null;
  readonly text: string;
}

export const latencyFailureWords: Record<LatencyFailure, string> = {
  timeout: 'No green cloud arrived: the request or the whole cloud was lost.',
  'no-session': 'Connect to a robot first.',
  'no-lease': 'Someone else is driving. Only the driver can run a latency test.',
  busy: 'A latency test is already running.',
};

/** What a latency test measured, in one line. */
export function latencyResultWords({ mtpMs, firstMs }: Pick<LatencyReport, 'mtpMs' | 'firstMs'>): string {
  return `Motion to photon ${mtpMs.toFixed(0)} ms (first points ${firstMs.toFixed(0)} ms)`;
}

/** The stages of the clouds that are shown. @param stages `null`: none is live */
export function cloudStageWords(stages: CloudStages | null): readonly StageWords[] {
  const splits = stages === null || stages.captureMs !== null;
  const way = 'Waiting at the robot, and network';
  return [
    stageOf('Capture', stages?.captureMs),
    stageOf('Encoding', stages?.encodeMs),
    stageOf(splits ? way : 'Robot and network together', stages?.wayMs),
    stageOf('Further packets of the frame', stages?.furtherMs),
    stageOf('Decoding', stages?.decodeMs),
    stageOf('Waiting for the display, and drawing', stages?.drawMs),
  ];
}

/** The stages of a latency test. @param stages `null`: they cannot be told */
export function testStageWords(stages: TestStages | null): readonly StageWords[] {
  return [
    stageOf('Command to the robot', stages?.commandMs),
    stageOf('Until the next capture', stages?.waitMs),
    stageOf('Cloud from capture to arrival', stages?.cloudMs),
    stageOf('Decoding and drawing', stages?.drawMs),
  ];
}

export function frameTotalWords(stages: FrameStages | null): string {
  return `Cloud, capture to display: ${ms(stages?.totalMs)}`;
}

/** @param minRttMs `null`: not known, or not live */
export function networkWords(minRttMs: number | null): string {
  const way = minRttMs === null ? NO_FIGURE : `about ${(minRttMs / 2).toFixed(1)} ms`;
  return `Network alone, one way: ${way} (half the shortest round trip)`;
}

/** What the latest test measured. */
export function lastTestWords(entry: LatencyEntry | undefined): string {
  if (entry === undefined) return 'No latency test yet.';
  const { report, failure, stages } = entry;
  if (report === null) return `Last test: ${failure === null ? 'failed' : latencyFailureWords[failure]}`;
  const split = stages === null ? '; its stages are unknown' : '';
  return `Last test, motion to photon: ${ms(report.mtpMs)}${split}`;
}

/** How many tests there are, and their spread. */
export function testsWords(entries: readonly LatencyEntry[]): string {
  const measured = entries.flatMap(({ report }) => (report === null ? [] : [report.mtpMs]));
  if (measured.length === 0) return entries.length === 0 ? '' : `${entries.length} failed`;
  measured.sort((a, b) => a - b);
  const median = measured[Math.ceil(measured.length / 2) - 1];
  const failed = entries.length - measured.length;
  const range = `${ms(measured[0])} to ${ms(measured.at(-1))}`;
  const tests = measured.length === 1 ? '1 test' : `${measured.length} tests`;
  const spread = measured.length === 1 ? '' : `: median ${ms(median)}, ${range}`;
  return `${tests}${spread}${failed === 0 ? '' : `; ${failed} failed`}`;
}

function stageOf(name: string, value: number | null | undefined): StageWords {
  return { name, ms: value ?? null, text: stageText(value) };
}

/** To tenths where a whole number would read 0. */
function stageText(value: number | null | undefined): string {
  return value === null || value === undefined || Math.abs(value) >= 10
    ? ms(value)
    : `${value.toFixed(1)} ms`;
}
