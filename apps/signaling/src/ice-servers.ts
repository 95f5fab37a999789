import { createHmac } from 'node:crypto';
import type { IceServer } from '@farpoint/protocol';

/** A TURN server that shares a secret with this service (coturn's `use-auth-secret`). */
export interface TurnRest {
  readonly urls: readonly string[];
  readonly secret: string;
  readonly ttlSeconds: number;
}

/**
 * Credentials that a TURN server can check without a user database: `username = expiry:name`, `credential =
 * base64(HMAC-SHA1(secret, username))` (draft-uberti-behave-turn-rest-00).
 *
 * @param nowSeconds Unix time
 */
export function turnCredentials(turn: TurnRest, name: string, nowSeconds: number): IceServer {
  const username = `${Math.floor(nowSeconds) + turn.ttlSeconds}:${name}`;
  const credential = createHmac('sha1', turn.secret).update(username).digest('base64');
  return { urls: [...turn.urls], username, credential };
}
