/** Which tests have to run after a change: those of which something has changed since they last passed here. Pure. */
import { type ExportingPackage, ImportGraph } from '../lib/import-graph.ts';
import { hashOf } from './groups.ts';

/** Tests of a step, by their files. A step that does not exist, or has no such file, is none. */
export interface Layer {
  step: string;
  tests: RegExp;
  /** Folders of what the tests run without importing it. */
  runs?: readonly string[];
  /** Steps that have to run before. */
  after?: readonly string[];
}

export const LAYERS: readonly Layer[] = [
  {
    step: 'pure',
    tests:
      /^(?:packages|apps|tools|wasm-codec|bench|scripts)\/(?!.*\.(?:stack|scenario)\.test\.ts$).*\.test\.ts$/,
  },
  { step: 'scenario', tests: /\.scenario\.test\.ts$/ },
  { step: 'page', tests: /^e2e\/pages\/.*\.page\.ts$/, runs: ['apps/webxr'], after: ['build'] },
];

/** Steps of which nobody knows what they read, and that are short. */
export const ALWAYS = ['lint', 'types'];

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
}

/** Every test file of the layers, with what it depends on. @param tools versions of what runs it */
export function testFiles(
  { files, packages, read }: Workspace,
  tools: string,
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
  const folderOf = (file: string): string | undefined =>
    packages.find(({ folder }) => file.startsWith(`${folder}/`))?.folder;
  const isIn = (file: string, folder: string) => file.startsWith(`${folder}/`);
  /** Vectors, WASM, documents: whatever tests read by their paths. */
  const dataOf = new Map(
    packages.map(({ folder }) => [folder, files.filter((file) => isIn(file, folder) && !SOURCE.test(file))]),
  );
  const everywhere = files.filter((file) => EVERYWHERE.includes(file));
  const tests: TestFile[] = [];
  for (const { step, tests: pattern, runs = [] } of layers) {
    const run = runs.flatMap((folder) =>
      files.filter((file) => isIn(file, folder) && !/\.test\.ts$/.test(file)),
    );
    const runClosure = new Set(run.flatMap((file) => graph.closureOf(file)));
    for (const file of files.filter((each) => pattern.test(each))) {
      const closure = new Set([...graph.closureOf(file), ...runClosure]);
      if (closure.has(WHOLE_WORKSPACE)) {
        tests.push({ step, file, hash: null });
        continue;
      }
      const folders = new Set([...closure].map(folderOf));
      const data = [...folders].flatMap((folder) => (folder === undefined ? [] : (dataOf.get(folder) ?? [])));
      const inputs = [...new Set([...closure, ...data, ...everywhere])].sort();
      const text = new TextEncoder().encode([tools, ...inputs.map(hashOfFile)].join('\n'));
      tests.push({ step, file, hash: hashOf([file], () => text) });
    }
  }
  return tests;
}

export interface Selection {
  /** Names of the steps to run. */
  steps: readonly string[];
  /** Files of each of these steps that has layers' tests. */
  files: ReadonlyMap<string, readonly string[]>;
  /** What runs and what does not, in one line. */
  leftOut: string;
}

/** @param isProven whether a test has passed here with this hash @param steps all that there are, in their order */
export function selectChanged(
  tests: readonly TestFile[],
  isProven: (hash: string) => boolean,
  steps: readonly string[],
  layers: readonly Layer[] = LAYERS,
): Selection {
  const there = tests.filter(({ step }) => steps.includes(step));
  const changed = there.filter(({ hash }) => hash === null || !isProven(hash));
  const files = new Map<string, string[]>();
  for (const { step, file } of changed) files.set(step, [...(files.get(step) ?? []), file]);
  const before = layers.filter(({ step }) => files.has(step)).flatMap(({ after = [] }) => after);
  const chosen = steps.filter((step) => [...ALWAYS, ...before].includes(step) || files.has(step));
  const others = steps.filter((step) => !chosen.includes(step) && !there.some((test) => test.step === step));
  const passed = there.length - changed.length;
  return {
    steps: chosen,
    files,
    leftOut: `left out: ${passed} of ${there.length} files of tests, which have passed here with what they depend on; ${others.join(', ')}`,
  };
}
