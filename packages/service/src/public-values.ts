import type { OptionTable } from './option-table.ts';
import { withoutCredentials } from './secret.ts';

type Json = null | boolean | number | string | readonly Json[] | { readonly [key: string]: Json };

/** Members of nested values that are secrets, whatever option they are in. */
const SECRET_MEMBER = /credential|password|passwd|secret|token|(^|[a-z])key$/i;

/**
 * The values that differ from their defaults, as JSON, without secrets: of a secret option, or a nested member whose
 * name says that it is one, only that it is set.
 */
export function publicValues(
  table: OptionTable,
  values: Readonly<Record<string, unknown>>,
): Record<string, Json> {
  const shown: Record<string, Json> = {};
  for (const [key, spec] of Object.entries(table)) {
    const value = toJson(values[key]);
    if (JSON.stringify(value) === JSON.stringify(toJson(spec.default))) continue;
    shown[key] = spec.secret ? 'set' : withoutSecrets(value);
  }
  return shown;
}

/** Infinity, which JSON does not have, becomes text. */
function toJson(value: unknown): Json {
  const text = JSON.stringify(value, (_, part: unknown) =>
    part === Number.POSITIVE_INFINITY ? 'infinite' : part,
  );
  return text === undefined ? null : (JSON.parse(text) as Json);
}

function withoutSecrets(value: Json): Json {
  if (typeof value === 'string') return withoutCredentials(value);
  if (typeof value !== 'object' || value === null) return value;
  if (isList(value)) return value.map(withoutSecrets);
  return Object.fromEntries(
    Object.entries(value).map(([name, member]) => [
      name,
      SECRET_MEMBER.test(name) && member !== null ? 'set' : withoutSecrets(member),
    ]),
  );
}

/** `Array.isArray` does not narrow to read-only arrays. */
function isList(value: Json): value is readonly Json[] {
  return Array.isArray(value);
}
