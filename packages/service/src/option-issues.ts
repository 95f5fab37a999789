/** Converts schema errors to sentences that name the place in the value. */
import type * as z from 'zod';
import { closest } from './closest.ts';

type Issue = z.core.$ZodIssue;
type Steps = (string | number)[];

/** A mistake inside one option's value. */
export interface ValueIssue {
  /** Keys and list positions from the value's root. */
  inside: Steps;
  /** Completes a sentence that begins with the place. */
  detail: string;
  found: unknown;
}

/** @param value the refused value */
export function valueIssues(schema: z.core.$ZodType, error: z.core.$ZodError, value: unknown): ValueIssue[] {
  const all = error.issues.flatMap((issue) => {
    const inside = steps(issue.path);
    if (issue.code === 'unrecognized_keys') {
      const known = knownKeys(schema, inside);
      return issue.keys.map((key) => ({
        inside: [...inside, key],
        detail: `is not a key here${closest(key, known) || (known.length === 0 ? '' : `; the keys are ${known.join(', ')}`)}`,
        found: at(value, [...inside, key]),
      }));
    }
    return [{ inside, detail: sentence(issue, at(value, inside)), found: at(value, inside) }];
  });
  // Errors that follow from the first one at a place add nothing.
  const places = new Set<string>();
  return all.filter(({ inside }) => {
    const place = inside.join('.');
    return !places.has(place) && places.add(place);
  });
}

/** Schemas of options have their own sentences; those of nested values may use zod's. */
function sentence(issue: Issue, found: unknown): string {
  if (!/^(Invalid|Too )/.test(issue.message)) return issue.message;
  const missing = found === undefined ? 'is missing: ' : '';
  switch (issue.code) {
    case 'invalid_type':
      return `${missing}must be ${article(issue.expected)}`;
    case 'invalid_value':
      return `${missing}must be one of ${issue.values.map(String).join(', ')}`;
    case 'too_small':
      return `must be ${unit(issue.origin, `at least ${issue.minimum}`)}`;
    case 'too_big':
      return `must be ${unit(issue.origin, `at most ${issue.maximum}`)}`;
    default:
      return `${missing}${issue.message.charAt(0).toLowerCase()}${issue.message.slice(1)}`;
  }
}

function unit(origin: string, limit: string): string {
  if (origin === 'string') return `${limit} characters long`;
  return origin === 'array' ? `${limit} entries long` : limit;
}

function article(type: string): string {
  const names: Record<string, string> = {
    object: 'a mapping',
    record: 'a mapping',
    array: 'a list',
    string: 'text',
    int: 'a whole number',
  };
  return names[type] ?? `a ${type}`;
}

function steps(path: readonly PropertyKey[]): Steps {
  return path.map((step) => (typeof step === 'number' ? step : String(step)));
}

function at(value: unknown, path: Steps): unknown {
  let here = value;
  for (const step of path) {
    // Text that the schema itself parsed: it is shown whole.
    if (typeof here !== 'object' || here === null) return here;
    here = (here as Record<string | number, unknown>)[step];
  }
  return here;
}

/** Keys of the mapping at a path, as far as the schema defines them. */
function knownKeys(schema: z.core.$ZodType, path: Steps): string[] {
  let here: SchemaShape | undefined = (schema as unknown as { _zod: { def: SchemaShape } })._zod.def;
  for (const step of [...path, null]) {
    while (here?.innerType !== undefined || here?.out !== undefined)
      here = (here.innerType ?? here.out)?._zod.def;
    if (step === null) break;
    here = (typeof step === 'number' ? here?.element : here?.shape?.[step])?._zod.def;
  }
  return Object.keys(here?.shape ?? {});
}

interface SchemaShape {
  innerType?: { _zod: { def: SchemaShape } };
  out?: { _zod: { def: SchemaShape } };
  element?: { _zod: { def: SchemaShape } };
  shape?: Record<string, { _zod: { def: SchemaShape } }>;
}
