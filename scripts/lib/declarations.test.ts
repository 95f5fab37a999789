import { expect, test } from 'vitest';
import { publicDeclaration, references } from './declarations.ts';

const name = (it: string) => (it === '@farpoint/protocol' ? '../protocol/index.js' : it);

test('removes schemas, and keeps the types beside them', () => {
  const text = `import * as z from 'zod/mini';
import type { Pose } from './pose.ts';
export interface Speed {
    x: number;
}
export interface Codec<T> {
    readonly schema: z.core.$ZodType<T>;
}
export declare const speedSchema: z.ZodMiniObject<{
    x: z.ZodMiniNumber<number>;
}, z.core.$strip>;
declare const one: z.ZodMiniString<string>;
export type One = z.infer<typeof one>;
export declare const MOST: 5;
`;
  expect(publicDeclaration(text, name)).toEqual({
    text: `import type { Pose } from './pose.js';
export interface Speed {
    x: number;
}
export interface Codec<T> {
    readonly schema: unknown;
}
export type One = unknown;
export declare const MOST: 5;
`,
    opaque: ['One'],
  });
});

test('refers to private packages by path, to others by name', () => {
  const text = `import type { A } from '@farpoint/protocol';\nimport { B } from 'three';\nexport * from './c.ts';\n`;
  const made = publicDeclaration(text, name).text;
  expect(made).toContain("from '../protocol/index.js'");
  expect(made).toContain("from 'three'");
  expect(references(made)).toEqual(['../protocol/index.js', './c.js']);
});

test('keeps a file that has only schemas a module', () => {
  expect(
    publicDeclaration(
      "import * as z from 'zod/mini';\nexport declare const a: z.ZodMiniString<string>;",
      name,
    ).text,
  ).toBe('export {};');
});

test('refuses an interface that is derived from a schema', () => {
  const text = 'export interface A {\n    one: z.infer<typeof one>;\n}';
  expect(() => publicDeclaration(text, name)).toThrow('z.infer');
});
