/** What is known of each group of tests here: its inputs, its tools, and whether both have passed together. */
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import * as z from 'zod';
import { root, run } from '../lib/run.ts';
import { readWorkspaceFile, workspaceFiles } from '../lib/workspace-files.ts';
import { type Group, hashOf, inputsOf, readGroups, type WorkspacePackage } from './groups.ts';
import { NEEDS } from './needs.ts';
import type { ProvenGroups } from './proven.ts';
import { versionsOf } from './provision.ts';

export interface GroupState {
  group: Group;
  inputs: string;
  tools: string;
  /** When this has passed; `null` if it has to run. */
  provenAt: string | null;
  /** What it needs and this machine has not. */
  missing: readonly string[];
  /** Whether what it tests has changed since it passed here. */
  hasChanged: boolean;
}

const manifestSchema = z.object({
  name: z.string(),
  dependencies: z.record(z.string(), z.string()).default({}),
  devDependencies: z.record(z.string(), z.string()).default({}),
});

/** The workspace's packages, by their `package.json`. */
export function workspacePackages(): WorkspacePackage[] {
  return workspaceFiles
    .filter((file) => /\/package\.json$/.test(file) && !/^examples\/|\/fixtures\//.test(file))
    .map((file) => {
      const { name, dependencies, devDependencies } = manifestSchema.parse(
        JSON.parse(readWorkspaceFile(file)),
      );
      return {
        folder: dirname(file),
        name,
        uses: Object.keys(dependencies),
        testsUse: Object.keys(devDependencies),
      };
    });
}

export function groupsOfWorkspace(): Group[] {
  return readGroups(readWorkspaceFile('tests/groups.yaml'));
}

/** @param missing names of needs that are not there @param all whether every group has to run */
export async function groupStates(
  proven: ProvenGroups,
  missing: readonly string[],
  all: boolean,
): Promise<GroupState[]> {
  const packages = workspacePackages();
  const states: GroupState[] = [];
  for (const group of groupsOfWorkspace()) {
    const inputs = hashOf(inputsOf(group, workspaceFiles, packages), (file) =>
      readFileSync(join(root, file)),
    );
    const tools = await toolsOf(group);
    states.push({
      group,
      inputs,
      tools,
      provenAt: all ? null : (proven.proof(group.name, inputs, tools)?.at ?? null),
      missing: group.needs.filter((name) => missing.includes(name)),
      hasChanged: proven.hasChanged(group.name, inputs),
    });
  }
  return states;
}

/** A hash of the versions of what runs the group. */
async function toolsOf({ name, needs }: Group): Promise<string> {
  const packages = NEEDS.filter((need) => needs.includes(need.name)).flatMap((need) => need.packages);
  const versions = [process.version, process.platform, process.arch, ...(await versionsOf(packages))];
  if (name === 'rust') versions.push((await run('rustc', ['-vV'])).output);
  return createHash('sha256').update(versions.join('\n')).digest('hex');
}
