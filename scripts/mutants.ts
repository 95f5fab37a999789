/**
 * `pnpm mutants [NAME…]`: puts each fault of tests/mutants.yaml into a copy of the last commit, one at a time, and runs the
 * tests that are to find it. Fails if one is not found. The copy is a git worktree in the folder for temporary files.
 */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { run } from './lib/run.ts';
import { readWorkspaceFile } from './lib/workspace-files.ts';
import { type Mutant, mutate, readMutants } from './test/mutant.ts';
import { nameOf, type Outcome } from './test/outcome.ts';
import { readPlaywrightReport } from './test/playwright-report.ts';
import { pureTestsOf } from './test/selection.ts';
import { durationWords } from './test/summary.ts';
import { readVitestReport } from './test/vitest-report.ts';

const { values, positionals: names } = parseArgs({
  allowPositionals: true,
  options: { help: { type: 'boolean', short: 'h' } },
});
const mutants = readMutants(readWorkspaceFile('tests/mutants.yaml'));
if (values.help) {
  console.log(`pnpm mutants [NAME…]

Puts each of these faults into a copy of the last commit, one at a time, and runs the tests that are to find it.

${mutants.map(({ name, what }) => `  ${name.padEnd(24)} ${what}`).join('\n')}`);
  process.exit(0);
}
const unknown = names.find((name) => !mutants.some((mutant) => mutant.name === name));
if (unknown !== undefined) {
  console.error(`there is no fault ${unknown}; pnpm mutants --help lists them`);
  process.exit(2);
}

const scratch = mkdtempSync(join(tmpdir(), 'farpoint-mutants-'));
const copy = join(scratch, 'farpoint');
const report = join(scratch, 'report.json');
const must = async (program: string, ...args: string[]): Promise<void> => {
  const { code, output } = await run(program, args, program === 'git' ? {} : { cwd: copy });
  if (code !== 0) throw new Error(`${program} ${args.join(' ')}:\n${output.slice(-2000)}`);
};
const chosen = mutants.filter(({ name }) => names.length === 0 || names.includes(name));
// Now, as the last commit is: somebody may go on to work in the workspace meanwhile.
const pureTests = pureTestsOf(chosen.map(({ file }) => file));
let isGreen = false;
try {
  console.log('copying the last commit');
  await must('git', 'worktree', 'add', '--detach', '--force', copy, 'HEAD');
  await must('pnpm', 'install', '--frozen-lockfile', '--prefer-offline');
  // It finds that a fault is there, which is not what the fault is to show.
  rmSync(join(copy, 'scripts/test/mutant.test.ts'));
  const tests = [...new Set(chosen.flatMap(({ foundBy }) => foundBy))];
  for (const each of tests) {
    console.log(`without a fault: ${each}`);
    const failed = await failuresOf(each);
    if (failed.length > 0) throw new Error(`${each} fails without a fault: ${failed.join(', ')}`);
  }
  const missed: string[] = [];
  for (const mutant of chosen) if (!(await isFound(mutant))) missed.push(mutant.name);
  isGreen = missed.length === 0;
  console.log(`\n${chosen.length - missed.length} of ${chosen.length} faults are found`);
  if (!isGreen) console.log(`again: pnpm mutants ${missed.join(' ')}`);
} catch (error) {
  console.error(error instanceof Error ? error.message : error);
} finally {
  await run('git', ['worktree', 'remove', '--force', copy]);
  rmSync(scratch, { recursive: true, force: true });
}
process.exit(isGreen ? 0 : 1);

async function isFound(mutant: Mutant): Promise<boolean> {
  const file = join(copy, mutant.file);
  const text = readFileSync(file, 'utf8');
  const began = performance.now();
  writeFileSync(file, mutate(mutant, text));
  try {
    for (const tests of mutant.foundBy) {
      const failed = await failuresOf(tests, pureTests.get(mutant.file));
      if (failed.length === 0) continue;
      const took = durationWords(performance.now() - began);
      console.log(`✓ ${mutant.name}: found by ${tests} (${took}): ${failed[0]}`);
      return true;
    }
    console.log(`✗ ${mutant.name}: not found by ${mutant.foundBy.join(', ')}`);
  } catch (error) {
    // The other faults are still worth trying, for most of an hour.
    console.error(
      `✗ ${mutant.name}: its tests could not be run: ${error instanceof Error ? error.message : error}`,
    );
  } finally {
    writeFileSync(file, text);
  }
  return false;
}

/**
 * Ends with the first test that fails: one that finds the fault is enough.
 *
 * @param pure the pure tests that can find it; default: all of them
 * @returns names of the tests that failed until then
 * @throws {Error} if the tests could not be run
 */
async function failuresOf(tests: string, pure: readonly string[] = []): Promise<string[]> {
  rmSync(report, { force: true });
  if (tests.startsWith('e2e/')) {
    await must('node', 'scripts/build.ts');
    const args = [
      '--dir',
      'e2e',
      'exec',
      'playwright',
      'test',
      '--project',
      tests.endsWith('.page.ts') ? 'page' : 'smoke',
      '--max-failures=1',
      '--reporter=json',
    ];
    await run('pnpm', [...args, tests.slice('e2e/'.length)], {
      cwd: copy,
      env: { PLAYWRIGHT_JSON_OUTPUT_FILE: report },
    });
    return failed(readPlaywrightReport(readFileSync(report, 'utf8'), 'e2e').outcomes);
  }
  const project = tests === 'pure' ? ['--project', 'pure', ...pure] : ['--project', projectOf(tests), tests];
  // The copy's own vitest: one of another place does not know the tests' `describe` and `it`.
  const args = ['exec', 'vitest', 'run', ...project, '--bail=1', '--reporter=json', `--outputFile=${report}`];
  await run('pnpm', args, { cwd: copy });
  return failed(readVitestReport(readFileSync(report, 'utf8'), copy).outcomes);
}

function projectOf(file: string): string {
  if (file.endsWith('.scenario.test.ts')) return 'scenario';
  return file.endsWith('.stack.test.ts') ? 'stack*' : 'pure';
}

function failed(outcomes: readonly Outcome[]): string[] {
  if (outcomes.every(({ status }) => status === 'skipped')) throw new Error('no test ran');
  // Files that have not begun when the first test fails are reported as failed, without a reason.
  const isReal = ({ status, title, reason }: Outcome) => status === 'failed' && `${title}${reason}` !== '';
  return outcomes.filter(isReal).map(nameOf);
}
