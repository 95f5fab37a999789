/** The packages of the workspace that are published, and how they are packed. */
import { dirname, join } from 'node:path';
import { root, run } from './run.ts';
import { readWorkspaceFile, workspaceFiles } from './workspace-files.ts';

export interface PublishedPackage {
  name: string;
  /** From the repository's root. */
  folder: string;
}

/** Packages of the workspace that are not marked private. */
export const publishedPackages: readonly PublishedPackage[] = workspaceFiles
  .filter((file) => /^packages\/[^/]+\/package\.json$/.test(file))
  .map((file) => ({
    folder: dirname(file),
    manifest: JSON.parse(readWorkspaceFile(file)) as { name: string; private?: boolean },
  }))
  .filter(({ manifest }) => manifest.private !== true)
  .map(({ folder, manifest: { name } }) => ({ name, folder }));

/**
 * Builds and packs a package. Needs no network and no registry.
 *
 * @param file the tarball to write
 * @throws {Error} with what pnpm says where it fails
 */
export async function packPackage({ name, folder }: PublishedPackage, file: string): Promise<void> {
  const { code, output } = await run('pnpm', ['pack', '--out', file], { cwd: join(root, folder) });
  if (code !== 0) throw new Error(`${name} cannot be packed:\n${output}`);
}
