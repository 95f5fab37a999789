import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { beforeEach, expect, test } from 'vitest';
import { bundledPackages, licenceTexts } from './bundled-licences.ts';

let root: string;
beforeEach(() => {
  root = testFolder();
});

test('packages are found in any store, each once; own files are none', () => {
  const files = [
    'src/index.ts',
    '../../node_modules/.pnpm/zod@4.0.0/node_modules/zod/v4/core.js',
    '../../node_modules/.pnpm/zod@4.0.0/node_modules/zod/v4/parse.js',
    'node_modules/@scope/name/index.js',
  ];
  expect([...bundledPackages(files)]).toEqual([
    ['@scope/name', 'node_modules/@scope/name'],
    ['zod', '../../node_modules/.pnpm/zod@4.0.0/node_modules/zod'],
  ]);
});

test('each licence stands under its package’s name', () => {
  for (const [name, file] of [
    ['a', 'LICENSE'],
    ['b', 'license.md'],
  ] as const) {
    mkdirSync(join(root, name));
    writeFileSync(join(root, name, file), `Terms of ${name}.\n`);
  }
  const text = licenceTexts(
    new Map([
      ['a', 'a'],
      ['b', 'b'],
    ]),
    root,
  );
  expect(text).toContain('a\n=\n\nTerms of a.\n');
  expect(text).toContain('b\n=\n\nTerms of b.\n');
  expect(licenceTexts(new Map(), root)).toBe(null);
});

test('a package without a licence is refused by name', () => {
  mkdirSync(join(root, 'c'));
  expect(() => licenceTexts(new Map([['c', 'c']]), root)).toThrow('c has no licence file');
});
