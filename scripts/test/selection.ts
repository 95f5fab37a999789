/** What has to run after a change on this machine, and what is known of it afterwards. */
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import * as z from 'zod';
import { type ExportingPackage, ImportGraph } from '../lib/import-graph.ts';
import { root } from '../lib/run.ts';
import { readWorkspaceFile, workspaceFiles } from '../lib/workspace-files.ts';
import { LAYERS, msTaken, type Selection, selectChanged, type TestFile, testFiles } from './changed.ts';
import { ProvenFiles } from './proven-files.ts';
import type { StepSummary } from './summary.ts';

const manifestSchema = z.object({ name: z.string(), exports: z.record(z.string(), z.unknown()).default({}) });

function exportingPackages(): ExportingPackage[] {
  return workspaceFiles
    .filter((file) => /\/package\.json$/.test(file) && !/^examples\/|\/fixtures\//.test(file))
    .map((file) => ({ folder: dirname(file), ...manifestSchema.parse(JSON.parse(readWorkspaceFile(file))) }));
}

/** The pure tests that import each file, themselves or through others: those that a fault in it can reach. */
export function pureTestsOf(files: Iterable<string>): Map<string, readonly string[]> {
  const graph = new ImportGraph(workspaceFiles, exportingPackages(), readWorkspaceFile);
  const pure = LAYERS.find(({ step }) => step === 'pure');
  const closures = workspaceFiles
    .filter((each) => pure?.tests.test(each))
    .map((each) => [each, new Set(graph.closureOf(each))] as const);
  const reaching = (file: string) =>
    closures.filter(([, closure]) => closure.has(file)).map(([test]) => test);
  return new Map([...new Set(files)].map((file) => [file, reaching(file)]));
}

function readTests(passed: ProvenFiles): TestFile[] {
  const contents = new Map<string, Uint8Array>();
  const read = (file: string): Uint8Array => {
    const known = contents.get(file) ?? readFileSync(join(root, file));
    contents.set(file, known);
    return known;
  };
  const tools = createHash('sha256').update([process.version, process.platform, process.arch].join());
  const workspace = { files: workspaceFiles, packages: exportingPackages(), read };
  return testFiles(workspace, tools.digest('hex'), passed);
}

/** None where a file is gone: what has passed then is not what is there. */
function hashesNow(passed: ProvenFiles): ReadonlySet<string | null> {
  try {
    return new Set(readTests(passed).map(({ hash }) => hash));
  } catch {
    return new Set();
  }
}

export class TestSelection {
  readonly #tests: readonly TestFile[];
  readonly #proven: ProvenFiles;

  /** Reads all files of the workspace, as they are before the tests. */
  constructor(proven = new ProvenFiles()) {
    this.#tests = readTests(proven);
    this.#proven = proven;
  }

  /** @param steps all that there are, in their order @param limitMs of {@link selectChanged} */
  changed(steps: readonly string[], limitMs: number): Selection {
    return selectChanged(this.#tests, this.#proven, steps, limitMs);
  }

  /** Remembers the files of which every test has passed, and nothing has changed meanwhile. */
  keepPassed(summaries: readonly StepSummary[]): void {
    const now = hashesNow(this.#proven);
    const passed = this.#tests.filter(({ step, file, hash }) => {
      if (!now.has(hash)) return false;
      const own = summaries
        .filter(({ name }) => name === step)
        .flatMap(({ judged }) => judged.filter((test) => test.file === file));
      return (
        own.some(({ verdict }) => verdict === 'passed') &&
        own.every(({ verdict }) => verdict === 'passed' || verdict === 'skipped')
      );
    });
    this.#proven.keep({
      tests: passed.flatMap(({ hash }) => (hash === null ? [] : [hash])),
      inputs: new Set(passed.flatMap(({ inputs }) => inputs)),
      ms: msTaken(summaries),
    });
  }
}
