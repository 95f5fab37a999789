/**
 * Which tests run after a change: those of which something has changed since they last passed here, the nearest to the
 * change first, as many as a minute has room for. Pure.
 */
import { type ExportingPackage, ImportGraph } from '../lib/import-graph.ts';
import { hashOf } from './groups.ts';
import type { StepSummary } from './summary.ts';

/** Tests of a step, by their files. A step that does not exist, or has no such file, is none. */
export interface Layer {
  step: string;
  tests: RegExp;
  /** Folders of what the tests run without importing it. */
  runs?: readonly string[];
  /** Steps that have to run before. */
  after?: readonly string[];
  /** What it takes before its first test runs, and what a file of tests takes of which nothing is known. */
  startMs: number;
  fileMs: number;
}

export const LAYERS: readonly Layer[] = [
  {
    step: 'pure',
    tests:
      /^(?:packages|apps|tools|wasm-codec|bench|scripts)\/(?!.*\.(?:stack|scenario)\.test\.ts$).*\.test\.ts$/,
    startMs: 2500,
    fileMs: 50,
  },
  { step: 'scenario', tests: /\.scenario\.test\.ts$/, startMs: 2500, fileMs: 1000 },
  {
    step: 'page',
    tests: /^e2e\/pages\/.*\.page\.ts$/,
    runs: ['apps/webxr'],
    after: ['build'],
    startMs: 6000,
    fileMs: 7000,
  },
];

/** Steps of which nobody knows what they read, and that are short. */
export const ALWAYS = ['lint', 'types'];
/** Of a step that is not known to take more or less. */
const STEP_MS = 5000;
/** A minute, less the start and the end of `pnpm test` on two cores (3 s). */
export const CHANGED_MS = 57_000;

/** What every test depends on. */
const EVERYWHERE = ['pnpm-lock.yaml', 'vitest.config.ts', 'tsconfig.base.json', 'scripts/lib/test-setup.ts'];
/** A test that imports this looks at all files of the workspace. */
const WHOLE_WORKSPACE = 'scripts/lib/workspace-files.ts';
const SOURCE = /\.(?:ts|tsx|js|mjs)$/;

export interface Workspace {
  files: readonly string[];
  packages: readonly ExportingPackage[];
  read(file: string): Uint8Array;
}

export interface TestFile {
  step: string;
  file: string;
  /** Of all that it depends on; `null` for a test of the whole workspace, which is never known to pass. */
  hash: string | null;
  /** Hashes of the files that it depends on, each with its path. */
  inputs: readonly string[];
  /** Imports between it and the nearest file that is new here; infinite where there is none, or nobody knows. */
  distance: number;
}

/** What this machine remembers of tests that have passed. */
export interface PassedBefore {
  /** Whether a test has passed with this hash of all that it depends on. */
  has(hash: string): boolean;
  /** Whether a test has passed that depends on a file with this hash. */
  hasInput(hash: string): boolean;
  /** What a file of tests, or a step, took when it last passed. */
  msOf(name: string): number | undefined;
}

/** Every test file of the layers, with what it depends on. @param tools versions of what runs it */
export function testFiles(
  { files, packages, read }: Workspace,
  tools: string,
  passed: Pick<PassedBefore, 'hasInput'>,
  layers: readonly Layer[] = LAYERS,
): TestFile[] {
  const decoder = new TextDecoder();
  const graph = new ImportGraph(files, packages, (file) => decoder.decode(read(file)));
  const hashes = new Map<string, string>();
  const hashOfFile = (file: string): string => {
    const known = hashes.get(file) ?? hashOf([file], read);
    hashes.set(file, known);
    return known;
  };
  const inputsOf = inputsReader({ files, packages, read }, graph);
  const tests = layers.flatMap((layer) =>
    files
      .filter((file) => layer.tests.test(file))
      .map((file) => {
        const inputs = inputsOf(layer, file)?.map(hashOfFile) ?? null;
        const text = new TextEncoder().encode([tools, ...(inputs ?? [])].join('\n'));
        const hash = inputs === null ? null : hashOf([file], () => text);
        return { step: layer.step, file, hash, inputs: inputs ?? [] };
      }),
  );
  const changed = [...hashes].filter(([, hash]) => !passed.hasInput(hash)).map(([file]) => file);
  const distanceOf = distanceReader({ files, packages, read }, graph, changed);
  return tests.map((test) => ({ ...test, distance: distanceOf(test.step, test.file, layers) }));
}

type Inputs = (layer: Layer, file: string) => readonly string[] | null;

/** @returns what reads the files on which a test depends, sorted; `null` for one that looks at all files */
function inputsReader({ files, packages }: Workspace, graph: ImportGraph): Inputs {
  /** Vectors, WASM, documents: whatever tests read by their paths. */
  const dataOf = new Map(
    packages.map(({ folder }) => [folder, files.filter((file) => isIn(file, folder) && !SOURCE.test(file))]),
  );
  const everywhere = files.filter((file) => EVERYWHERE.includes(file));
  const runBy = new Map<Layer, ReadonlySet<string>>();
  const whatRuns = (layer: Layer): ReadonlySet<string> => {
    const known =
      runBy.get(layer) ?? new Set(filesRunBy(layer, files).flatMap((file) => graph.closureOf(file)));
    runBy.set(layer, known);
    return known;
  };
  return (layer, file) => {
    const closure = new Set([...graph.closureOf(file), ...whatRuns(layer)]);
    if (closure.has(WHOLE_WORKSPACE)) return null;
    const folders = new Set([...closure].map((each) => folderOf(each, packages)));
    const data = [...folders].flatMap((folder) => (folder === undefined ? [] : (dataOf.get(folder) ?? [])));
    return [...new Set([...closure, ...data, ...everywhere])].sort();
  };
}

/** @param changed files @returns what reads the distance of a test of a step to the nearest of them */
function distanceReader({ files, packages }: Workspace, graph: ImportGraph, changed: readonly string[]) {
  const folders = new Set(
    changed.filter((file) => !SOURCE.test(file)).map((file) => folderOf(file, packages)),
  );
  // Which of a folder's sources reads a file of data is not known: each may.
  const readers = files.filter((file) => SOURCE.test(file) && folders.has(folderOf(file, packages) ?? '/'));
  const distances = graph.distancesTo([...changed.filter((file) => SOURCE.test(file)), ...readers]);
  const distanceTo = (file: string): number => distances.get(file) ?? Number.POSITIVE_INFINITY;
  return (step: string, test: string, layers: readonly Layer[]): number => {
    const layer = layers.find((each) => each.step === step);
    const run = layer === undefined ? [] : filesRunBy(layer, files);
    return Math.min(distanceTo(test), ...run.map((file) => distanceTo(file) + 1));
  };
}

function filesRunBy({ runs = [] }: Layer, files: readonly string[]): string[] {
  return runs.flatMap((folder) => files.filter((file) => isIn(file, folder) && !/\.test\.ts$/.test(file)));
}

function isIn(file: string, folder: string): boolean {
  return file.startsWith(`${folder}/`);
}

function folderOf(file: string, packages: readonly ExportingPackage[]): string | undefined {
  return packages.find(({ folder }) => isIn(file, folder))?.folder;
}

export interface Selection {
  /** Names of the steps to run. */
  steps: readonly string[];
  /** Files of each of these steps that has layers' tests. */
  files: ReadonlyMap<string, readonly string[]>;
  /** What runs and what does not, in one line. */
  leftOut: string;
}

/**
 * @param steps all that there are, in their order @param limitMs how long all of it may take, by what it last took;
 * infinite for all that has changed
 */
export function selectChanged(
  tests: readonly TestFile[],
  passed: PassedBefore,
  steps: readonly string[],
  limitMs: number,
  layers: readonly Layer[] = LAYERS,
): Selection {
  const there = tests.filter(({ step }) => steps.includes(step));
  const changed = there.filter(({ hash }) => hash === null || !passed.has(hash));
  const files = new Map<string, string[]>();
  const later = new Map<string, number>();
  const before = (layer: Layer) => layer.after ?? [];
  const msOfSteps = (names: readonly string[]) =>
    names.reduce((sum, name) => sum + (passed.msOf(name) ?? STEP_MS), 0);
  let ms = msOfSteps(ALWAYS.filter((name) => steps.includes(name)));
  for (const layer of layers) {
    const own = changed.filter(({ step }) => step === layer.step);
    const msOf = ({ file }: TestFile) => passed.msOf(file) ?? layer.fileMs;
    for (const test of own.toSorted((a, b) => rank(a, b) || msOf(a) - msOf(b))) {
      const chosen = files.get(layer.step);
      const isFirst = files.size === 0;
      const start = chosen === undefined ? layer.startMs + msOfSteps(before(layer)) : 0;
      // One test always runs, so that further runs come to an end.
      if (!isFirst && ms + start + msOf(test) > limitMs) {
        later.set(layer.step, (later.get(layer.step) ?? 0) + 1);
        continue;
      }
      ms += start + msOf(test);
      if (chosen === undefined) files.set(layer.step, [test.file]);
      else chosen.push(test.file);
    }
  }
  const needed = layers.filter(({ step }) => files.has(step)).flatMap(before);
  const chosen = steps.filter((step) => [...ALWAYS, ...needed].includes(step) || files.has(step));
  const others = steps.filter((step) => !chosen.includes(step) && !there.some((test) => test.step === step));
  const unchanged = there.length - changed.length;
  const left = `left out: ${unchanged} of ${there.length} files of tests, which have passed here with what they depend on; ${others.join(', ')}`;
  const counts = [...later].map(([step, count]) => `${count} ${step}`).join(', ');
  const next = `left for later: ${counts} (files of tests, farther from the change than a minute reaches): the same command again goes on with them; --changed --all takes all at once`;
  return { steps: chosen, files, leftOut: later.size === 0 ? left : `${left}\n${next}` };
}

/** Tests that look at everything first, then those nearest to the change. */
function rank(a: TestFile, b: TestFile): number {
  const distance = ({ hash, distance }: TestFile) => (hash === null ? -1 : distance);
  const [first, second] = [distance(a), distance(b)];
  return first === second ? 0 : first - second;
}

/** Of a file of tests besides its tests: loading what it imports. */
const LOADING_MS = 30;

/**
 * What steps took that passed, and in the layers' steps each file of tests its share: files run beside each other, so
 * that what they take together is less than the sum of what each takes.
 */
export function msTaken(
  summaries: readonly Pick<StepSummary, 'name' | 'ms' | 'ok' | 'judged'>[],
  layers: readonly Layer[] = LAYERS,
): Record<string, number> {
  const taken: Record<string, number> = {};
  for (const { name, ms, ok, judged } of summaries) {
    if (!ok) continue;
    const layer = layers.find(({ step }) => step === name);
    if (layer === undefined) {
      taken[name] = ms;
      continue;
    }
    const own = new Map<string, number>();
    for (const test of judged) own.set(test.file, (own.get(test.file) ?? LOADING_MS) + test.ms);
    const sum = [...own.values()].reduce((total, each) => total + each, 0);
    for (const [file, each] of own) taken[file] = (Math.max(0, ms - layer.startMs) * each) / sum;
  }
  return taken;
}
