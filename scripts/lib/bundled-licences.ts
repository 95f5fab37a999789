/** The licences of the packages that a bundle contains: most of them ask for their text to travel with the code. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

const PACKAGE = /^(?<folder>.*\bnode_modules\/(?<name>(?:@[^/]+\/)?[^/]+))\//;

/**
 * The folders of the installed packages that source files belong to, by package name.
 *
 * @param files paths of source files; those outside `node_modules` are the workspace's own and are left out
 */
export function bundledPackages(files: Iterable<string>): Map<string, string> {
  const found = new Map<string, string>();
  for (const file of files) {
    const groups = PACKAGE.exec(file)?.groups;
    if (groups !== undefined) found.set(groups.name!, groups.folder!);
  }
  return new Map([...found].sort(([a], [b]) => (a < b ? -1 : 1)));
}

/**
 * One text with the licence of each package; `null` where there is none to name.
 *
 * @param root what the folders are relative to
 * @throws {Error} where a package has no licence file: it may not be bundled
 */
export function licenceTexts(packages: ReadonlyMap<string, string>, root: string): string | null {
  if (packages.size === 0) return null;
  const sections = [...packages].map(([name, folder]) => {
    const file = readdirSync(join(root, folder)).find((each) => /^licen[cs]e(\.(md|txt))?$/i.test(each));
    if (file === undefined) throw new Error(`${name} has no licence file, so it cannot be bundled`);
    return `${name}\n${'='.repeat(name.length)}\n\n${readFileSync(join(root, folder, file), 'utf8').trim()}\n`;
  });
  return `These modules contain code of the following packages.\n\n${sections.join('\n\n')}`;
}
