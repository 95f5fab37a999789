/** Operators' tokens, each kept for the signaling service that it was given for: no other service is ever sent it. */
import { tokenSchema } from '@farpoint/protocol';

/** By origin of the service's address, e.g. `wss://robots.example.org`. */
export type SignalingTokens = ReadonlyMap<string, string>;

/** The oldest are forgotten. */
const MOST_ORIGINS = 32;

/** Whose token an address takes: scheme, host and port. @param url of the service, as `readSettings` gives it */
export function tokenOrigin(url: string): string {
  return new URL(url).origin;
}

/** What of a stored object can be used. */
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

/** @param token empty forgets it */
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
