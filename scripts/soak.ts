/**
 * `pnpm soak`: what takes too long for every change: every test in its long form, tests beside busy programs, other seeds,
 * faults that tests must find, benchmarks. For the night, and before a release.
 */
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs, stripVTControlCharacters } from 'node:util';
import * as z from 'zod';
import { root, run } from './lib/run.ts';
import { readWorkspaceFile } from './lib/workspace-files.ts';
import { type Figures, farFromMedians, figuresIn, withNewest } from './soak/figures.ts';
import { PARTS, planSoak, type SoakPart, stepsOf } from './soak/plan.ts';
import { readRecord, type SoakRecord } from './soak/record.ts';
import { expiredQuarantine, type PartResult, resultsPage } from './soak/results.ts';
import { cacheFolder } from './test/proven.ts';
import { readQuarantine } from './test/quarantine.ts';
import { STEPS } from './test/steps.ts';

const LIST = PARTS.map(
  ({ name, what, minutes }) => `  ${name.padEnd(11)} ${`${minutes} min`.padStart(6)}  ${what}`,
).join('\n');
const HELP = `pnpm soak [PART…] [--without PART[,PART…]] [--mutants] [--seed N] [--resume] [--list]

${LIST}

  PART…      only these parts
  --without  all parts but these
  --mutants  only the part mutants
  --seed N   of properties; default: another one each day
  --resume   goes on with a soak of the same commit that was ended: without the parts that have passed, with its seed
  --list     say which parts would run, and how long they take

It ends with one page of results, which is also in .farpoint/soak.md, and fails if a part has failed. Figures of benchmarks
that are far from the medians of earlier soaks on this machine are named, and do not fail.`;

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    without: { type: 'string' },
    mutants: { type: 'boolean', default: false },
    seed: { type: 'string' },
    resume: { type: 'boolean', default: false },
    list: { type: 'boolean', default: false },
    help: { type: 'boolean', short: 'h' },
  },
});
if (values.help) {
  console.log(HELP);
  process.exit(0);
}

const DAY_MS = 86_400_000;
const LAST_LINES = 40;
const plan = readPlan();
if (values.list) {
  for (const { name, minutes, what } of plan) console.log(`${name.padEnd(11)} ${minutes} min  ${what}`);
  console.log(`about ${plan.reduce((sum, { minutes }) => sum + minutes, 0)} min`);
  process.exit(0);
}

const figuresFile = join(cacheFolder(), 'soak-figures.json');
const recordFile = join(root, '.farpoint', 'soak.json');
const commit = await readCommit();
const { seed, results } = readEarlier();
for (const [index, part] of plan.entries()) {
  if (results.some(({ name }) => name === part.name)) continue;
  console.log(`\n[${index + 1}/${plan.length}] ${part.name}: ${part.what}`);
  const began = performance.now();
  const result = await runPart(part);
  const ms = performance.now() - began;
  results.push({ name: part.name, what: part.what, ms, words: '', lastLines: [], ...result });
  // Somebody who ends a soak has what it has shown so far.
  savePage();
}
console.log(`\n${savePage()}`);
process.exit(results.some(({ outcome }) => outcome === 'failed') ? 1 : 0);

function savePage(): string {
  const inOrder = PARTS.flatMap(({ name }) => results.find((result) => result.name === name) ?? []);
  const page = resultsPage(inOrder, { commit, seed, at: new Date() });
  mkdirSync(join(root, '.farpoint'), { recursive: true });
  writeFileSync(recordFile, JSON.stringify({ commit, seed, results } satisfies SoakRecord));
  writeFileSync(join(root, '.farpoint', 'soak.md'), page);
  return page;
}

type Outcome = Pick<PartResult, 'outcome'> & Partial<Pick<PartResult, 'words' | 'lastLines'>>;

async function runPart(part: SoakPart): Promise<Outcome> {
  if (part.name === 'quarantine') {
    const lastLines = expiredQuarantine(
      readQuarantine(readWorkspaceFile('tests/quarantine.yaml')),
      Date.now(),
    );
    return { outcome: lastLines.length === 0 ? 'passed' : 'failed', lastLines };
  }
  const steps = stepsOf(
    part,
    STEPS.map(({ name }) => name),
  );
  if (steps === null) return { outcome: 'left out', words: `there is no step ${part.steps?.join(', ')}` };
  let output = '';
  // What an earlier soak has left would be appended to.
  for (const folder of part.equalLogs ?? []) {
    rmSync(join(root, folder), { recursive: true, force: true });
    mkdirSync(join(root, folder), { recursive: true });
  }
  for (const { args, env = {} } of part.commands(steps, seed)) {
    const result = await run(process.execPath, [...args], { echo: true, env: { ...env } });
    output = stripVTControlCharacters(result.output);
    if (result.code !== 0)
      return { outcome: 'failed', lastLines: output.trimEnd().split('\n').slice(-LAST_LINES) };
  }
  if (part.equalLogs !== undefined) return compareLogs(part.equalLogs);
  if (part.hasFigures) return { outcome: 'passed', words: compareFigures(part.name, figuresIn(output)) };
  return { outcome: 'passed', words: output.trimEnd().split('\n').at(-1) ?? '' };
}

function compareLogs(folders: readonly string[]): Outcome {
  const logs = folders.map((folder) => {
    const names = readdirSync(join(root, folder)).sort();
    return names.map((name) => readFileSync(join(root, folder, name), 'utf8')).join('');
  });
  if (logs.every((log) => log !== '' && log === logs[0])) return { outcome: 'passed', words: 'equal logs' };
  return {
    outcome: 'failed',
    lastLines: [`${folders.join(' and ')} differ: the runs are not deterministic`],
  };
}

/** Keeps the figures for later soaks. @returns what to say of them */
function compareFigures(name: string, figures: Figures): string {
  const all = readFigures();
  const earlier = all[name] ?? [];
  const far = farFromMedians(figures, earlier);
  mkdirSync(cacheFolder(), { recursive: true });
  writeFileSync(figuresFile, JSON.stringify({ ...all, [name]: withNewest(earlier, figures) }));
  const count = `${Object.keys(figures).length} figures, ${earlier.length} earlier soaks`;
  return far.length === 0 ? count : `${count}; far from the median: ${far.slice(0, 3).join(', ')}`;
}

function readFigures(): Record<string, Figures[]> {
  try {
    const schema = z.record(z.string(), z.array(z.record(z.string(), z.number())));
    return schema.parse(JSON.parse(readFileSync(figuresFile, 'utf8')));
  } catch {
    // Without earlier soaks there are no medians.
    return {};
  }
}

/** `null` if something is not committed, or if this is no clone. */
async function readCommit(): Promise<string | null> {
  const [head, changes] = [
    await run('git', ['rev-parse', 'HEAD']),
    await run('git', ['status', '--porcelain']),
  ];
  return head.code === 0 && changes.code === 0 && changes.output === '' ? head.output.trim() : null;
}

/** The soak that goes on, or an empty one. */
function readEarlier(): SoakRecord {
  const nothing: SoakRecord = { commit, seed: readSeed(), results: [] };
  if (!values.resume) return nothing;
  const earlier = readRecord(existsSync(recordFile) ? readFileSync(recordFile, 'utf8') : null, commit);
  if (typeof earlier !== 'string') {
    if (values.seed === undefined || earlier.seed === readSeed()) return earlier;
    console.error(
      `--seed: the soak that goes on has the seed ${earlier.seed}; leave out --seed, or --resume`,
    );
    process.exit(2);
  }
  console.log(`Everything runs from the beginning: ${earlier}.`);
  return nothing;
}

function readSeed(): number {
  const seed = values.seed === undefined ? Math.floor(Date.now() / DAY_MS) : Number(values.seed);
  if (Number.isInteger(seed) && seed > 0) return seed;
  console.error(`--seed: a whole number above 0 is needed, not ${values.seed}`);
  process.exit(2);
}

function readPlan(): SoakPart[] {
  try {
    return planSoak(values.mutants ? ['mutants'] : positionals, values.without?.split(',') ?? []);
  } catch (error) {
    console.error(error instanceof Error ? error.message : error);
    process.exit(2);
  }
}
