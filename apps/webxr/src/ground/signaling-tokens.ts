/** Operators' tokens. Each belongs to one signaling service and is never sent to another. */
import { tokenSchema } from '@farpoint/protocol';

/** Keyed by the origin of the service's address, e.g. `wss://robots.example.org`. */
export type SignalingTokens = ReadonlyMap<string, string>;

/** Beyond this number, the oldest tokens are dropped. */
const MOST_ORIGINS = 32;

/**
 * The key of a service's token: scheme, host and port. @param url address of the service, as `readSettings` returns
 * it
 */
export function tokenOrigin(url: string): string {
  return new URL(url).origin;
}

/** The usable entries of a stored object. */
export function parseTokens(value: unknown): SignalingTokens {
  if (typeof value !== 'object' || value === null || Array.isArray(value)) return new Map();
  return new Map(
    Object.entries(value)
      .filter(
        (entry): entry is [string, string] => isOrigin(entry[0]) && tokenSchema.safeParse(entry[1]).success,
      )
      .slice(-MOST_ORIGINS),
  );
}

/** @param token an empty token removes the entry */
export function withToken(tokens: SignalingTokens, origin: string, token: string): SignalingTokens {
  const next = new Map(tokens);
  next.delete(origin);
  if (token !== '') next.set(origin, token);
  return new Map([...next].slice(-MOST_ORIGINS));
}

function isOrigin(text: string): boolean {
  try {
    return /^wss?:$/.test(new URL(text).protocol) && new URL(text).origin === text;
  } catch {
    return false;
  }
}
