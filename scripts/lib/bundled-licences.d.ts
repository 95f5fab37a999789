/**
 * The folders of the installed packages that source files belong to, by package name.
 *
 * @param files paths of source files; those outside `node_modules` are the workspace's own and are left out
 */
export declare function bundledPackages(files: Iterable<string>): Map<string, string>;
/**
 * One text with the licence of each package; `null` where there is none to name.
 *
 * @param root what the folders are relative to
 * @throws {Error} where a package has no licence file: it may not be bundled
 */
export declare function licenceTexts(packages: ReadonlyMap<string, string>, root: string): string | null;
