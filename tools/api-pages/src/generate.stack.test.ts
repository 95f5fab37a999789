import { mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { expect, test } from 'vitest';
import { apiPages } from './generate.ts';

/** TypeDoc compiles everything that the packages use. */
const LONG_MS = 120_000;

test(
  'docs/api is fresh: else run pnpm docs:api',
  async () => {
    const folder = join(import.meta.dirname, '../../../docs/api');
    const pages = await apiPages();
    expect(readdirSync(folder).sort()).toEqual([...pages.keys()]);
    for (const [file, text] of pages) expect(readFileSync(join(folder, file), 'utf8'), file).toBe(text);
  },
  LONG_MS,
);

/** The page of a package of one module. */
async function pageOf(module: string): Promise<string> {
  const folder = testFolder();
  mkdirSync(join(folder, 'src'));
  writeFileSync(
    join(folder, 'package.json'),
    JSON.stringify({ name: '@farpoint/operator', version: '1.0.0' }),
  );
  writeFileSync(join(folder, 'tsconfig.json'), JSON.stringify({ compilerOptions: { types: [] } }));
  const entry = join(folder, 'src/index.ts');
  writeFileSync(entry, module);
  const pages = await apiPages({ entryPoints: [entry], tsconfig: join(folder, 'tsconfig.json') });
  return [...pages.values()].join('\n');
}

test(
  'an export without a docstring is a fault, and so is a property',
  async () => {
    const module = '/** Settings. */\nexport interface Settings { speed: number }\nexport const NONE = 1;\n';
    const faults = [expect.stringContaining('Settings.speed'), expect.stringContaining('NONE')];
    await expect(pageOf(module)).rejects.toMatchObject({ faults });
  },
  LONG_MS,
);

test(
  'a link that leads nowhere is a fault',
  async () => {
    const module = '/** As {@link nothing} has it. */\nexport const ONE = 1;\n';
    await expect(pageOf(module)).rejects.toMatchObject({ faults: [expect.stringContaining('nothing')] });
  },
  LONG_MS,
);

test(
  'members of a union and the class that is thrown stand on the page',
  async () => {
    const module = `/** A side. */
export type Side =
  /** Where the heart is. */
  | 'left'
  | 'right';

/** Turns. @throws {RangeError} without a side */
export function turn(): void {}
`;
    const page = await pageOf(module);
    expect(page).toContain('A side.\n\n- `"left"`: Where the heart is.\n');
    expect(page).toContain('`RangeError` without a side');
  },
  LONG_MS,
);
