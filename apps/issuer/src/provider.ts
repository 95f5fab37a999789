/** The OpenID Connect provider: the code flow with PKCE, by openid-client. */

import { isProtectedUrl } from '@farpoint/protocol';
import type { Secret } from '@farpoint/service';
import {
  allowInsecureRequests,
  authorizationCodeGrant,
  buildAuthorizationUrl,
  type Configuration,
  calculatePKCECodeChallenge,
  discovery,
  enableNonRepudiationChecks,
  fetchUserInfo,
  None,
} from 'openid-client';
import type { PendingSignIn } from './pending-sign-ins.ts';
import { faultText, finishFault, SignInRefusedError } from './provider-fault.ts';
import type { Claims } from './rules.ts';

export interface ProviderOptions {
  /** The provider's issuer: an https address (http on loopback only). */
  provider: string;
  clientId: string;
  clientSecret: Secret | null;
  /** Scopes, separated by spaces. */
  scope: string;
  /** Also asks the provider's UserInfo endpoint. */
  userInfo: boolean;
  /** For each request. */
  timeoutMs: number;
}

/** What a provider proved. */
export interface SignedIn {
  issuer: string;
  sub: string;
  claims: Claims;
}

/** The provider's description is read anew after this time. */
const DESCRIPTION_MS = 3_600_000;

export class Provider {
  readonly #options: ProviderOptions;
  readonly #callbackUrl: string;
  #description: { config: Promise<Configuration>; readMs: number } | null = null;
  /** Whether the last attempt to read the provider's description succeeded; `null` before the first. */
  reachable: boolean | null = null;

  constructor(options: ProviderOptions, callbackUrl: string) {
    this.#options = options;
    this.#callbackUrl = callbackUrl;
  }

  /**
   * The address at the provider where a person signs in.
   *
   * @throws {SignInRefusedError} `provider-unreachable`
   */
  async begin(
    state: string,
    { nonce, verifier }: Pick<PendingSignIn, 'nonce' | 'verifier'>,
    nowMs: number,
  ): Promise<string> {
    const config = await this.#configuration(nowMs);
    return buildAuthorizationUrl(config, {
      redirect_uri: this.#callbackUrl,
      scope: this.#options.scope,
      state,
      nonce,
      code_challenge: await calculatePKCECodeChallenge(verifier),
      code_challenge_method: 'S256',
    }).href;
  }

  /**
   * Exchanges the code, and verifies the ID token: issuer, audience, nonce, expiry, and the signature with the
   * provider's published keys.
   *
   * @param query of the address with which the browser came back
   * @throws {SignInRefusedError}
   */
  async finish(
    query: URLSearchParams,
    state: string,
    { nonce, verifier }: Pick<PendingSignIn, 'nonce' | 'verifier'>,
    nowMs: number,
  ): Promise<SignedIn> {
    const config = await this.#configuration(nowMs);
    try {
      const tokens = await authorizationCodeGrant(config, new URL(`${this.#callbackUrl}?${query}`), {
        expectedState: state,
        expectedNonce: nonce,
        pkceCodeVerifier: verifier,
        idTokenExpected: true,
      });
      const claims = tokens.claims();
      if (claims === undefined) throw new SignInRefusedError('unproven', 'there is no ID token');
      const more = this.#options.userInfo ? await fetchUserInfo(config, tokens.access_token, claims.sub) : {};
      return { issuer: claims.iss, sub: claims.sub, claims: { ...more, ...claims } };
    } catch (error) {
      const fault = finishFault(error, [query.get('code') ?? '', verifier]);
      // The provider's keys may be others now than those that were read.
      if (fault.reason === 'unproven') this.#description = null;
      throw fault;
    }
  }

  async #configuration(nowMs: number): Promise<Configuration> {
    let current = this.#description;
    if (current === null || nowMs - current.readMs > DESCRIPTION_MS) {
      current = { config: this.#discover(), readMs: nowMs };
      this.#description = current;
    }
    try {
      const config = await current.config;
      this.reachable = true;
      return config;
    } catch (error) {
      if (this.#description === current) this.#description = null;
      this.reachable = false;
      throw new SignInRefusedError(
        'provider-unreachable',
        `its description cannot be read: ${faultText(error)}`,
      );
    }
  }

  #discover(): Promise<Configuration> {
    const { provider, clientId, clientSecret, timeoutMs } = this.#options;
    const url = new URL(provider);
    const onLoopback = url.protocol === 'http:' && isProtectedUrl(provider);
    return discovery(url, clientId, clientSecret?.reveal(), clientSecret === null ? None() : undefined, {
      execute: [enableNonRepudiationChecks, ...(onLoopback ? [allowInsecureRequests] : [])],
      timeout: timeoutMs / 1000,
    });
  }
}
