/** Finds the files that a TypeScript source imports by relative path, including types. Pure. */
import { posix } from 'node:path';

const RELATIVE = /(?:\bfrom|^\s*import|\bimport\()\s*['"](?<specifier>\.{1,2}\/[^'"\n]+)['"]/gm;
const STARTED = /\bnew URL\(\s*['"](?<specifier>\.{1,2}\/[\w./-]+\.ts)['"]/g;
const COMMENTS = /\/\*[\s\S]*?\*\/|^\s*\/\/.*$/gm;

/** @returns the imported files, relative to the same root as `file`; does not check that they exist */
export function importedFiles(file: string, source: string): Set<string> {
  return filesNamed(RELATIVE, file, source);
}

/** @returns the files that it starts as threads or programs, relative to the same root as `file` */
export function startedFiles(file: string, source: string): Set<string> {
  return filesNamed(STARTED, file, source);
}

function filesNamed(pattern: RegExp, file: string, source: string): Set<string> {
  const text = source.replace(COMMENTS, '');
  const files = new Set<string>();
  for (const { groups } of text.matchAll(pattern)) {
    files.add(posix.normalize(posix.join(posix.dirname(file), groups!.specifier!)));
  }
  return files;
}
