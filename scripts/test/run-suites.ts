/** Runs vitest and Playwright, reads their reports, and runs again what failed. */
import { mkdirSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { stripVTControlCharacters } from 'node:util';
import { root, run } from '../lib/run.ts';
import type { Outcome } from './outcome.ts';
import { readPlaywrightReport } from './playwright-report.ts';
import type { Quarantined } from './quarantine.ts';
import { MOST_AGAIN, namePattern, runFilesAgain } from './second-runs.ts';
import { type Judged, judge, SECOND_RUNS, toRunAgain } from './verdict.ts';
import { readVitestReport } from './vitest-report.ts';

export interface SuiteResult {
  judged: Judged[];
  /** What went wrong besides tests; `null` if nothing did. */
  failure: string | null;
}

const REPORTS = join(root, '.farpoint', 'reports');
const LAST_LINES = 20;

/** @returns where the report goes; what was there is removed */
function reportFile(name: string): string {
  mkdirSync(REPORTS, { recursive: true });
  const file = join(REPORTS, `${name}.json`);
  rmSync(file, { force: true });
  return file;
}

function lastLines(output: string): string {
  return output.trimEnd().split('\n').slice(-LAST_LINES).join('\n');
}

/** The text of a report, or `null` where the tool ended without one. */
function reportIn(file: string): string | null {
  try {
    return readFileSync(file, 'utf8');
  } catch {
    return null;
  }
}

export interface VitestOptions {
  /** One or, with `*`, several of the projects in vitest.config.ts. */
  project: string;
  /** Files that do not run. */
  without?: readonly string[];
  /** The only files that run; default: all. */
  files?: readonly string[] | undefined;
  /** Whether a test that failed is run again, because it depends on processes and real time. */
  again: boolean;
  quarantine?: readonly Quarantined[];
}

export async function runVitest({
  project,
  without = [],
  files = [],
  again,
  quarantine = [],
}: VitestOptions): Promise<SuiteResult> {
  const vitest = async (name: string, args: readonly string[]) => {
    const file = reportFile(name);
    const { code, output } = await run(
      'vitest',
      ['run', '--project', project, ...args, '--reporter=default', '--reporter=json', `--outputFile=${file}`],
      { echo: true, env: { FARPOINT_PASSED_TESTS: without.join('\n') } },
    );
    const text = reportIn(file);
    return { code, output, report: text === null ? null : readVitestReport(text, root) };
  };
  const name = project.replace('*', '');
  const first = await vitest(name, files);
  if (first.report === null) return { judged: [], failure: lastLines(first.output) };
  const { outcomes, fileMs } = first.report;
  const alone = await runFilesAgain(
    again ? toRunAgain(outcomes, quarantine) : [],
    fileMs,
    async (file, titles) => {
      console.log(`  again, alone: ${file}`);
      const named = titles === null ? [] : ['-t', namePattern(titles)];
      const { report } = await vitest(`${name}-again`, [file, ...named]);
      return report?.outcomes ?? [];
    },
  );
  const judged = judge(outcomes, alone, quarantine);
  return { judged, failure: outsideTests(first.code, first.output, outcomes) };
}

/** Vitest's report does not have them. */
const UNHANDLED = /⎯ Unhandled Errors ⎯/;

/** Errors outside tests, which no second run excuses. @returns what is known of them, or `null` if there are none */
function outsideTests(code: number, output: string, outcomes: readonly Outcome[]): string | null {
  const isExplained = outcomes.some(({ status }) => status === 'failed');
  const text = stripVTControlCharacters(output);
  const at = text.search(UNHANDLED);
  if (at >= 0) return text.slice(at).split('\n').slice(0, LAST_LINES).join('\n');
  return code !== 0 && !isExplained ? lastLines(text) : null;
}

export interface PlaywrightOptions {
  /** The only files that run; default: all. */
  files?: readonly string[] | undefined;
  project: 'page' | 'smoke' | 'firefox';
  /** As of {@link VitestOptions}. */
  again: boolean;
  quarantine: readonly Quarantined[];
}

/** Playwright names files relative to its configuration. */
const FOLDER = 'e2e';

export async function runPlaywright({
  project,
  files = [],
  again: mayRunAgain,
  quarantine,
}: PlaywrightOptions): Promise<SuiteResult> {
  const playwright = async (name: string, args: readonly string[], env: Record<string, string> = {}) => {
    const file = reportFile(name);
    const { code, output } = await run(
      'pnpm',
      [
        '--dir',
        'e2e',
        'exec',
        'playwright',
        'test',
        '--project',
        project,
        '--reporter',
        'list,json',
        ...args,
      ],
      { echo: true, env: { PLAYWRIGHT_JSON_OUTPUT_FILE: file, ...env } },
    );
    const text = reportIn(file);
    return { code, output, report: text === null ? null : readPlaywrightReport(text, FOLDER) };
  };
  const first = await playwright(
    project,
    files.map((file) => file.slice(`${FOLDER}/`.length)),
  );
  if (first.report === null) return { judged: [], failure: lastLines(first.output) };
  const { outcomes, errors } = first.report;
  const alone: Outcome[] = [];
  let again = 0;
  const failed = mayRunAgain ? toRunAgain(outcomes, quarantine) : [];
  for (const { file, line } of failed.slice(0, MOST_AGAIN)) {
    const place = `${file.slice(`${FOLDER}/`.length)}:${line ?? ''}`;
    console.log(`  again, alone, ${SECOND_RUNS} times: ${place}`);
    const { report } = await playwright(`${project}-again`, [place, `--repeat-each=${SECOND_RUNS}`], {
      FARPOINT_SECOND_RUN: `${project}-again-${++again}`,
    });
    alone.push(...(report?.outcomes ?? []));
  }
  const hasFailed = outcomes.some(({ status }) => status === 'failed');
  const failure =
    errors.length > 0 ? errors.join('\n') : first.code !== 0 && !hasFailed ? lastLines(first.output) : null;
  return { judged: judge(outcomes, alone, quarantine), failure };
}
