import { expect, test } from 'vitest';
import { importedPackages, packageOf, repeatedImports } from './package-imports.ts';

test('a specifier belongs to its package, whatever its subpath', () => {
  expect(packageOf('three/addons/loaders/GLTFLoader.js')).toBe('three');
  expect(packageOf('@farpoint/network-sim/random')).toBe('@farpoint/network-sim');
  for (const none of ['./a.ts', '../a.ts', '/a.ts', '#a', 'node:fs', 'fs', 'data:text/javascript,1'])
    expect(packageOf(none)).toBeNull();
});

test('finds every form of import, but none in comments', () => {
  const source = `
/** import 'commented'; */
import one from 'one';
import {
  type A,
  b,
} from 'two/b';
import type { C } from '@scope/three';
export * from 'four';
import 'five';
const six = await import('six');
type Seven = import('seven').Seven;
// import eight from 'eight';
const nine = createRequire(import.meta.url)('nine/package.json');
const ten = import.meta.resolve('ten');
const eleven = createRequire(import.meta.url).resolve('eleven/bin/eleven.js');
import { readFileSync } from 'node:fs';
import { own } from './own.ts';
`;
  expect([...importedPackages(source)].sort()).toEqual(
    ['@scope/three', 'eleven', 'five', 'four', 'nine', 'one', 'seven', 'six', 'ten', 'two'].sort(),
  );
});

test('finds what is imported twice, also once as a type, but not the whole of a module beside its names', () => {
  const source = [
    "import type { A } from './a.ts';",
    'import {\n  b,\n} from "./a.ts";',
    "import { c } from 'one';",
    "import type { D } from 'two';",
    "import * as two from 'two';",
    "// import { e } from 'one';",
  ].join('\n');
  expect(repeatedImports(source)).toEqual(['./a.ts']);
});
