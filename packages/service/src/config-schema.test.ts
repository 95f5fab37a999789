import { Ajv } from 'ajv';
import { describe, expect, test } from 'vitest';
import { parse } from 'yaml';
import * as z from 'zod';
import { configSchema } from './config-schema.ts';
import * as schema from './option-schemas.ts';
import { defineOption, defineProgram, optionGroup } from './option-table.ts';
import { resolveOptions } from './options.ts';

const program = defineProgram({
  name: 'farpoint-robot',
  summary: 'A robot.',
  version: '1.2.3',
  section: 'robot',
  options: {
    name: defineOption({ schema: schema.text({ max: 8 }), default: 'r1', help: 'its name' }),
    key: defineOption({ schema: schema.optional(schema.text()), default: null, help: 'a key', secret: true }),
    flagOnly: defineOption({ schema: schema.boolean(), default: false, help: 'no key', file: false }),
    size: defineOption({
      schema: schema.size({ min: 100, none: true }),
      default: Number.POSITIVE_INFINITY,
      help: 'a size',
    }),
    servers: defineOption({
      schema: schema.list(z.strictObject({ url: z.string(), port: z.optional(z.int()) })),
      default: [],
      help: 'servers',
    }),
    ...optionGroup('limits', {
      speed: defineOption({ schema: schema.number({ min: 0, max: 2 }), default: 1, help: 'm/s' }),
      retries: defineOption({ schema: schema.integer({ min: 0 }), default: 3, help: 'times' }),
      mode: defineOption({ schema: schema.choice(['slow', 'fast']), default: 'slow', help: 'how' }),
      brake: defineOption({ schema: schema.boolean(), default: true, help: 'whether' }),
    }),
  },
});
const made = configSchema([program]);
const validate = new Ajv({ allowUnionTypes: true, validateFormats: false }).compile(made);

function isRead(text: string): boolean {
  try {
    resolveOptions(program, { argv: [], env: {}, readFile: () => text });
    return true;
  } catch {
    return false;
  }
}

describe('the JSON Schema of a configuration file', () => {
  test.each([
    'robot: {}',
    'robot: { name: kitchen }',
    'robot: { name: 7 }',
    'robot: { key: }',
    'robot: { size: 500MB }',
    'robot: { size: 4 GB }',
    'robot: { size: none }',
    'robot: { size: 1000 }',
    'robot: { servers: [{ url: a, port: 1 }, { url: b }] }',
    'robot: { limits: { speed: 0.5, retries: 0, mode: fast, brake: no } }',
    'robot: { log: { level: debug } }',
  ])('allows what the program reads: %s', (text) => {
    expect(isRead(text)).toBe(true);
    expect(validate(parse(text)), JSON.stringify(validate.errors)).toBe(true);
  });

  test.each([
    'robot: { nme: kitchen }',
    'robot: { name: much too long }',
    'robot: { size: 5 bits }',
    'robot: { size: 10 }',
    'robot: { servers: [{ port: 1 }] }',
    'robot: { servers: [{ url: a, prt: 1 }] }',
    'robot: { limits: { speed: 3 } }',
    'robot: { limits: { retries: 1.5 } }',
    'robot: { limits: { mode: faster } }',
    'robot: { limits: { brake: perhaps } }',
    'robot: { limits: { sped: 1 } }',
    'robot: { speed: 1 }',
    'robot: { flagOnly: true }',
    'robot: 7',
  ])('refuses what the program refuses: %s', (text) => {
    expect(isRead(text)).toBe(false);
    expect(validate(parse(text))).toBe(false);
  });

  test('explains each key, and shows no secret', () => {
    expect(made).toMatchObject({
      properties: {
        robot: {
          description: 'A robot.',
          properties: {
            name: { description: 'its name', default: 'r1' },
            limits: { properties: { mode: { description: 'how', default: 'slow' } } },
          },
        },
      },
    });
    expect(JSON.stringify(made)).not.toContain('Infinity');
  });

  test('is printed by the flag', () => {
    const printed = resolveOptions(program, { argv: ['--config-schema'], env: {} });
    expect(printed).toMatchObject({ action: 'print' });
    expect(JSON.parse('text' in printed ? printed.text : '')).toEqual(JSON.parse(JSON.stringify(made)));
  });
});
