export interface BrowserPackage {
  /** Of the package. */
  folder: string;
  /** Modules that are addressed by themselves, below `src`: the package's own, and its workers. */
  entries: readonly string[];
  /** Packages that the built modules import by name. All others of the workspace that it needs are bundled. */
  external?: readonly string[];
  /** Files that the modules load at run time, from the package's folder. */
  assets?: readonly string[];
}
/** @throws {Error} with what the compiler says */
export declare function buildBrowserPackage(spec: BrowserPackage): Promise<void>;
