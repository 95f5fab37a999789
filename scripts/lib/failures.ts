import { stripVTControlCharacters } from 'node:util';

/** Where the test runners begin to list what failed: vitest, Playwright, cargo. */
const FAILURE_LIST = /^(?:⎯+ Failed (?:Suites|Tests) \d+ ⎯+|⎯+ Unhandled Errors ⎯+| {2}1\) \[.*|failures:)$/;
const MOST_LINES = 120;

/**
 * The part of a failed step's output that says what failed, to be printed again at the end of a long run, where a
 * reader looks first: the runner's list of failures, or the last lines where there is none. At most 120 lines.
 */
export function failuresOf(output: string): string {
  const lines = stripVTControlCharacters(output).trimEnd().split('\n');
  const list = lines.findIndex((line) => FAILURE_LIST.test(line));
  return (list < 0 ? lines.slice(-MOST_LINES) : lines.slice(list, list + MOST_LINES)).join('\n');
}

/** One failed test in a runner's list: vitest's ` FAIL  stack  a.test.ts > title`, Playwright's `  2) [chromium] › …`. */
const FAILED_TEST = /^\s*(?:FAIL\s+(?<vitest>\S.*?)|\d+\) (?<playwright>\[.*?))(?:\s─+)?\s*$/;

/** The names of the tests that failed, each once, in the runner's order: a list that is short where the reasons are not. */
export function failedTests(output: string): string[] {
  const names = new Set<string>();
  for (const line of stripVTControlCharacters(output).split('\n')) {
    const match = FAILED_TEST.exec(line)?.groups;
    const name = match?.vitest ?? match?.playwright;
    if (name !== undefined) names.add(name.trim());
  }
  return [...names];
}
