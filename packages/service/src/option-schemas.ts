import * as z from 'zod';
import { Secret } from './secret.ts';

/**
 * Schemas for options. Each accepts both text from a flag or the environment and typed values from YAML. Its messages
 * complete the sentence "<option> …", for example "must be a whole number from 0 to 65535".
 */

export function text(limits: { min?: number; max?: number } = {}): z.ZodType<string> {
  const { min = 1, max = 4096 } = limits;
  const range = `must be ${min}–${max} characters long`;
  // YAML reads an unquoted 7 or true as a number or a boolean; for a name, the text is meant.
  return z.preprocess(
    (value) => (typeof value === 'number' || typeof value === 'boolean' ? String(value) : value),
    z.string('must be text').min(min, range).max(max, range),
  ) as z.ZodType<string>;
}

export function number(limits: { min?: number; max?: number } = {}): z.ZodType<number> {
  return described(numeric('a number', limits, Number.isFinite), { type: 'number', ...bounds(limits) });
}

export function integer(limits: { min?: number; max?: number } = {}): z.ZodType<number> {
  return described(numeric('a whole number', limits, Number.isSafeInteger), {
    type: 'integer',
    ...bounds(limits),
  });
}

/** A TCP or UDP port; 0 chooses any free one. */
export function port(): z.ZodType<number> {
  return integer({ min: 0, max: 65_535 });
}

const SIZE_UNITS: Readonly<Record<string, number>> = { '': 1, k: 1e3, m: 1e6, g: 1e9, t: 1e12 };

/** Bytes: a number, or text with a unit (`500MB`, `4 GB`, 10^6 and 10^9). If allowed, `none` means infinity. */
export function size(limits: { min: number; none?: boolean }): z.ZodType<number> {
  const { min, none = false } = limits;
  const message = `must be a size such as 500MB or 4GB, of at least ${min} bytes${none ? ', or none' : ''}`;
  const read = z.unknown().transform((value, context) => {
    if (none && (value === 'none' || value === false)) return Number.POSITIVE_INFINITY;
    const [, digits, unit = ''] = /^(\d+(?:\.\d+)?) ?([kmgt]?)b?$/i.exec(String(value).trim()) ?? [];
    const bytes = Number(digits) * (SIZE_UNITS[unit.toLowerCase()] ?? Number.NaN);
    if ((typeof value === 'string' || typeof value === 'number') && bytes >= min) return bytes;
    context.addIssue({ code: 'custom', message });
    return z.NEVER;
  });
  return described(read, { type: ['number', 'string'] });
}

export function boolean(): z.ZodType<boolean> {
  const words = new Map([
    ['true', true],
    ['yes', true],
    ['on', true],
    ['1', true],
    ['false', false],
    ['no', false],
    ['off', false],
    ['0', false],
  ]);
  const schema = z.unknown().transform((value, context) => {
    const read =
      typeof value === 'boolean' ? value : words.get(typeof value === 'string' ? value.toLowerCase() : '');
    if (read !== undefined) return read;
    context.addIssue({ code: 'custom', message: 'must be true or false' });
    return z.NEVER;
  });
  return described(schema, { type: 'boolean' });
}

export function choice<const T extends readonly [string, ...string[]]>(values: T): z.ZodType<T[number]> {
  return z.enum(values, `must be one of ${values.join(', ')}`) as z.ZodType<T[number]>;
}

/** Comma-separated text, or a YAML list. */
export function list<T>(element: z.core.$ZodType<T>): z.ZodType<T[]> {
  return z.preprocess(
    (value) =>
      typeof value === 'string'
        ? value
            .split(',')
            .map((part) => part.trim())
            .filter((part) => part !== '')
        : value,
    z.array(element, 'must be a list'),
  ) as z.ZodType<T[]>;
}

/** A text that is never shown. */
export function secret(schema: z.core.$ZodType<string>): z.ZodType<Secret> {
  const held = z.pipe(
    schema,
    z.transform((text: string) => new Secret(text)),
  );
  return described(held, { type: 'string' });
}

/** An option that may be omitted. Its default is `null`. */
export function optional<T>(schema: z.core.$ZodType<T>): z.ZodType<T | null> {
  return z.nullable(schema);
}

/** Says what JSON Schema cannot read from a function that reads values. */
function described<T>(schema: z.ZodType<T>, keywords: Readonly<Record<string, unknown>>): z.ZodType<T> {
  return schema.meta(keywords);
}

function bounds({ min, max }: { min?: number; max?: number }): Record<string, number> {
  return {
    ...(min === undefined ? {} : { minimum: min }),
    ...(max === undefined ? {} : { maximum: max }),
  };
}

function numeric(
  what: string,
  limits: { min?: number; max?: number },
  accepts: (value: number) => boolean,
): z.ZodType<number> {
  const { min, max } = limits;
  const range =
    min !== undefined && max !== undefined
      ? ` from ${min} to ${max}`
      : min !== undefined
        ? ` of at least ${min}`
        : max !== undefined
          ? ` of at most ${max}`
          : '';
  return z.unknown().transform((value, context) => {
    const read = typeof value === 'string' && value.trim() !== '' ? Number(value) : value;
    if (
      typeof read === 'number' &&
      accepts(read) &&
      read >= (min ?? Number.NEGATIVE_INFINITY) &&
      read <= (max ?? Number.POSITIVE_INFINITY)
    ) {
      return read;
    }
    context.addIssue({ code: 'custom', message: `must be ${what}${range}` });
    return z.NEVER;
  });
}
