/** The one page on which a soak ends. Pure. */
import { daysLeft, type Quarantined } from '../test/quarantine.ts';
import { durationWords } from '../test/summary.ts';

export interface PartResult {
  name: string;
  what: string;
  /** `left out`: there is nothing to do for it. */
  outcome: 'passed' | 'failed' | 'left out';
  ms: number;
  /** What it says, in short. */
  words: string;
  /** The end of its output, where it failed. */
  lastLines: readonly string[];
}

const MOST_LAST_LINES = 15;
const WIDTH = 140;
const MARKS = { passed: '✓', failed: '✗', 'left out': '–' } as const;

/**
 * In Markdown that reads as text, too.
 *
 * @param commit `null`: a tree with uncommitted changes
 * @param at when it ended
 */
export function resultsPage(
  results: readonly PartResult[],
  { commit, seed, at }: { commit: string | null; seed: number; at: Date },
): string {
  const failed = results.filter(({ outcome }) => outcome === 'failed');
  const total = results.reduce((sum, { ms }) => sum + ms, 0);
  const name = Math.max(...results.map((result) => result.name.length));
  const rows = results.map((result) =>
    cut(
      `${MARKS[result.outcome]} ${result.name.padEnd(name)}  ${durationWords(result.ms).padStart(9)}  ${result.words || result.what}`,
    ),
  );
  const verdict =
    failed.length === 0
      ? 'Everything passed'
      : `${failed.length} of ${results.length} parts failed: ${failed.map((each) => each.name).join(', ')}`;
  const of = commit === null ? 'With uncommitted changes' : `Commit ${commit.slice(0, 8)}`;
  const details = failed.flatMap((result) => [
    '',
    `## ${result.name}: ${result.what}`,
    '',
    '```',
    ...result.lastLines.slice(-MOST_LAST_LINES).map(cut),
    '```',
  ]);
  return [
    `# Soak of ${at.toISOString().slice(0, 16).replace('T', ' ')} UTC`,
    '',
    `${verdict}, in ${durationWords(total)}. ${of}, seed ${seed}.`,
    '',
    '```',
    ...rows,
    '```',
    ...details,
    '',
  ].join('\n');
}

/** Words for each test that has been in quarantine for longer than was promised. @param nowMs since 1970 */
export function expiredQuarantine(quarantine: readonly Quarantined[], nowMs: number): string[] {
  return quarantine
    .filter((entry) => daysLeft(entry, nowMs) < 0)
    .map((entry) => `${entry.test}: expired ${-daysLeft(entry, nowMs)} days ago: mend it or delete it`);
}

function cut(line: string): string {
  return line.length > WIDTH ? `${line.slice(0, WIDTH - 1)}…` : line;
}
