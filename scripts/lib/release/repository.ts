/** The repository that a release is made of: what git and the files say of it, and what a release changes. */
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { root, run } from '../run.ts';
import type { ReleasePlan, RepositoryState } from './plan.ts';

const CHANGELOG = join(root, 'CHANGELOG.md');

export function readState(): RepositoryState {
  const { version } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8')) as { version: string };
  const changed = lines('status', '--porcelain', '--untracked-files=all');
  return {
    branch: lines('branch', '--show-current')[0] ?? null,
    changedFiles: changed.map((line) => line.slice(3)),
    tags: lines('tag', '--list'),
    version,
    changelog: readFileSync(CHANGELOG, 'utf8'),
  };
}

/**
 * Gives every package of the workspace the version, and dates the changelog.
 *
 * @throws {Error} with what pnpm says where it fails
 */
export async function writeRelease({ version, changelog }: ReleasePlan): Promise<void> {
  await succeed('pnpm', ['version', version, '--recursive', '--no-git-checks', '--allow-same-version']);
  writeFileSync(CHANGELOG, changelog);
}

/**
 * Commits what {@link writeRelease} wrote and tags it. Nothing is pushed.
 *
 * @throws {Error} with what git says where it fails
 */
export async function commitRelease({ version, tag, notes }: ReleasePlan): Promise<void> {
  await succeed('git', ['commit', '--all', '--message', `Release ${version}`]);
  // The notes' headings begin with #, which git would take for comments.
  await succeed('git', ['tag', '--annotate', tag, '--cleanup=whitespace', '--message', `${tag}\n\n${notes}`]);
}

/** Undoes what {@link writeRelease} wrote: a release begins with a clean working tree. */
export async function restoreFiles(): Promise<void> {
  await succeed('git', ['restore', '--staged', '--worktree', '.']);
}

function lines(...args: string[]): string[] {
  const text = execFileSync('git', args, { cwd: root, encoding: 'utf8' });
  return text.split('\n').filter((line) => line !== '');
}

async function succeed(program: string, args: string[]): Promise<void> {
  const { code, output } = await run(program, args);
  if (code !== 0) throw new Error(`${program} ${args[0]} failed:\n${output}`);
}
