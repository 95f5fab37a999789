/**
 * Groups of tests that need to run only when what they test has changed (`tests/groups.yaml`). What a group tests is
 * known by a hash of its inputs: its tests, the packages that it names, and those that they use. Pure.
 */
import { createHash } from 'node:crypto';
import { parse } from 'yaml';
import * as z from 'zod';

const groupSchema = z.strictObject({
  /** What is not known while it does not run. */
  what: z.string(),
  /** Files of tests. Empty for a step of its own. */
  tests: z.array(z.string()).default([]),
  /** Files, and folders with all that is in them. Of a package, those that it uses count as well. */
  inputs: z.array(z.string()),
  /** What has to be installed for it: names in scripts/test/needs.ts. */
  needs: z.array(z.string()).default([]),
});

export type Group = z.infer<typeof groupSchema> & { name: string };

/** @throws {Error} that says what is wrong, and where */
export function readGroups(yaml: string): Group[] {
  const groups = z.record(z.string(), groupSchema).parse(parse(yaml));
  return Object.entries(groups).map(([name, group]) => ({ name, ...group }));
}

/** A workspace's package. */
export interface WorkspacePackage {
  folder: string;
  name: string;
  /** Packages that its sources use, by name, and those that only its tests and tools use. */
  uses: readonly string[];
  testsUse: readonly string[];
}

/** Inputs of every group: with which versions of libraries tests run, and how. */
const EVERYWHERE = ['pnpm-lock.yaml', 'package.json', 'vitest.config.ts', 'tsconfig.base.json'];
const TEST = /\.test\.ts$/;

/**
 * The files on which a group's outcome depends, sorted. Tests of other groups and of none are not among them.
 *
 * @param files all of the workspace
 */
export function inputsOf(
  group: Group,
  files: readonly string[],
  packages: readonly WorkspacePackage[],
): string[] {
  const byName = new Map(packages.map((each) => [each.name, each]));
  const roots = packages.filter(({ folder }) =>
    [...group.inputs, ...group.tests].some((path) => path === folder || path.startsWith(`${folder}/`)),
  );
  const folders = new Set(group.inputs);
  const add = (name: string): void => {
    const used = byName.get(name);
    if (used === undefined || folders.has(used.folder)) return;
    folders.add(used.folder);
    for (const further of used.uses) add(further);
  };
  for (const { uses, testsUse } of roots) for (const name of [...uses, ...testsUse]) add(name);
  const tests = new Set(group.tests);
  return files
    .filter((file) => {
      if (tests.has(file) || EVERYWHERE.includes(file)) return true;
      if (TEST.test(file)) return false;
      return [...folders].some((folder) => file === folder || file.startsWith(`${folder}/`));
    })
    .sort();
}

/** @param read bytes of a file */
export function hashOf(files: readonly string[], read: (file: string) => Uint8Array): string {
  const hash = createHash('sha256');
  for (const file of files) hash.update(`${file} ${createHash('sha256').update(read(file)).digest('hex')}\n`);
  return hash.digest('hex');
}
