import { createHmac } from 'node:crypto';
import type { IceServer } from '@farpoint/protocol';
import type { SignalingOptions } from './options.ts';

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

type IceOptions = Pick<SignalingOptions, 'iceServers' | 'turnUrls' | 'turnSecret' | 'turnTtlSeconds'>;

/** The configured ICE servers, and the TURN servers with credentials for this robot or operator. */
export function iceServersFor(name: string, options: IceOptions): IceServer[] {
  const { iceServers, turnUrls: urls, turnSecret, turnTtlSeconds: ttlSeconds } = options;
  if (turnSecret === null || urls.length === 0) return [...iceServers];
  const turn = { urls, secret: turnSecret.reveal(), ttlSeconds };
  return [...iceServers, turnCredentials(turn, name, Date.now() / 1000)];
}
