/** What went wrong with the provider, as a reason for the page and a text for the log. */

import type { SignInError } from '@farpoint/protocol';
import {
  AuthorizationResponseError,
  ClientError,
  ResponseBodyError,
  WWWAuthenticateChallengeError,
} from 'openid-client';

/** Nobody is signed in. */
export class SignInRefusedError extends Error {
  override readonly name = 'SignInRefusedError';
  readonly reason: SignInError;

  /** @param detail for the log; it names no token or code */
  constructor(reason: SignInError, detail: string) {
    super(detail);
    this.reason = reason;
  }
}

/** Errors of openid-client which say that a response was not what it must be. */
const UNPROVEN = new Set([
  'OAUTH_INVALID_RESPONSE',
  'OAUTH_JWT_TIMESTAMP_CHECK_FAILED',
  'OAUTH_JWT_CLAIM_COMPARISON_FAILED',
  'OAUTH_JSON_ATTRIBUTE_COMPARISON_FAILED',
  'OAUTH_KEY_SELECTION_FAILED',
  'OAUTH_UNSUPPORTED_OPERATION',
  'OAUTH_PARSE_ERROR',
  'OAUTH_RESPONSE_IS_NOT_JSON',
]);
const UNREACHABLE = new Set(['OAUTH_TIMEOUT', 'OAUTH_ABORT']);
/** Errors by which a provider says that it cannot answer now (RFC 6749, section 4.1.2.1). */
const UNAVAILABLE = new Set(['server_error', 'temporarily_unavailable']);

/** @param secrets what must not be in the log */
export function finishFault(error: unknown, secrets: readonly string[]): SignInRefusedError {
  if (error instanceof SignInRefusedError) return error;
  const text = secrets
    .filter((secret) => secret !== '')
    .reduce((rest, secret) => rest.replaceAll(secret, '…'), faultText(error));
  return new SignInRefusedError(reasonOf(error), text);
}

function reasonOf(error: unknown): SignInRefusedError['reason'] {
  if (error instanceof AuthorizationResponseError) {
    if (error.error === 'access_denied') return 'cancelled';
    return UNAVAILABLE.has(error.error) ? 'provider-unreachable' : 'provider-refused';
  }
  if (error instanceof ResponseBodyError || error instanceof WWWAuthenticateChallengeError)
    return error.status >= 500 ? 'provider-unreachable' : 'provider-refused';
  if (error instanceof ClientError) {
    if (UNREACHABLE.has(error.code ?? '')) return 'provider-unreachable';
    if (UNPROVEN.has(error.code ?? '')) return 'unproven';
    if (error.cause instanceof Response)
      return error.cause.status >= 500 ? 'provider-unreachable' : 'provider-refused';
  }
  return networkCode(error) === null ? 'issuer-failed' : 'provider-unreachable';
}

/** The error in a few words. Causes are left out where they hold tokens or what is said of a person. */
export function faultText(error: unknown): string {
  if (error instanceof AuthorizationResponseError || error instanceof ResponseBodyError)
    return [error.error, error.error_description].filter(Boolean).join(': ').slice(0, 300);
  if (error instanceof WWWAuthenticateChallengeError) return `HTTP status ${error.status}`;
  if (error instanceof ClientError) {
    const inner = error.cause instanceof Error ? `: ${error.cause.message}` : '';
    const status = error.cause instanceof Response ? `: ${error.cause.status}` : '';
    return `${error.message}${inner}${status}`.slice(0, 300);
  }
  return networkCode(error) ?? String(error).slice(0, 300);
}

/** `ECONNREFUSED` and the like, which `fetch` has as the cause of its TypeError. */
function networkCode(error: unknown): string | null {
  const { cause } = error instanceof TypeError ? error : { cause: null };
  if (!(cause instanceof Error)) return null;
  return 'code' in cause && typeof cause.code === 'string' ? cause.code : cause.message;
}
