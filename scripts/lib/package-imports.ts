/** Finds the packages that a source file imports, and those that its text names, and modules imported twice. Pure. */
import { isBuiltin } from 'node:module';

/** `from '…'`, `import '…'`, `import('…')`, `require('…')`, `import.meta.resolve('…')`, `require.resolve('…')`. */
const IMPORTS = [
  /^\s*(?:import|export)\b[^'"`;]*?\bfrom\s*['"](?<specifier>[^'"\n]+)['"]/gm,
  /^\s*import\s*['"](?<specifier>[^'"\n]+)['"]/gm,
  /\b(?:import|import\.meta\.resolve|require|require\.resolve|createRequire\([^()]*\)(?:\.resolve)?|vi\.mock)\(\s*['"](?<specifier>[^'"\n]+)['"]/g,
];
const COMMENTS = /\/\*[\s\S]*?\*\/|^\s*\/\/.*$/gm;

/** The package that a specifier belongs to; `null` for files, Node's own modules and addresses. */
export function packageOf(specifier: string): string | null {
  if (/^[./#]/.test(specifier) || /^[a-z]+:/.test(specifier) || isBuiltin(specifier)) return null;
  const [first, second] = specifier.split('/');
  return first!.startsWith('@') ? `${first}/${second}` : first!;
}

/** The packages that a TypeScript or JavaScript source imports, in any form. */
export function importedPackages(source: string): Set<string> {
  const text = source.replace(COMMENTS, '');
  const packages = new Set<string>();
  for (const pattern of IMPORTS) {
    for (const { groups } of text.matchAll(pattern)) {
      const name = packageOf(groups!.specifier!);
      if (name !== null) packages.add(name);
    }
  }
  return packages;
}

/** @returns the modules that a source imports by two declarations with names in braces, which could be one */
export function repeatedImports(source: string): string[] {
  const text = source.replace(COMMENTS, '');
  const declarations = text.matchAll(/^import (?:type )?\{[^}]*\} from ['"](?<specifier>[^'"\n]+)['"]/gm);
  const modules = [...declarations].map(({ groups }) => groups!.specifier!);
  return [...new Set(modules.filter((module, i) => modules.indexOf(module) < i))];
}
