/** A real OpenID Connect provider on loopback (oidc-provider), with login forms, for tests. */
import { generateKeyPairSync, type KeyObject, randomUUID, sign } from 'node:crypto';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import Provider, { type Configuration, type JWK } from 'oidc-provider';

/** What the provider says of a person who signs in under this name. */
export type People = Readonly<Record<string, Readonly<Record<string, unknown>>>>;

export interface LoginProviderOptions {
  people: People;
  /** Where the issuer takes codes. */
  callbackUrl: string;
  /** `null`: a public client. */
  clientSecret?: string | null;
  /** A fixed port, to start again where one was before. */
  port?: number;
  /** Whether claims are in the ID token, or only at the UserInfo endpoint. */
  claimsInIdToken?: boolean;
  /** Changes the token endpoint's answers on their way out, as somebody who forges them would. */
  forge?: Forger | undefined;
}

/**
 * @param tokens the answer, to be changed in place
 * @param provider with which ID tokens can be signed
 */
export type Forger = (
  tokens: Record<string, unknown>,
  provider: Pick<LoginProvider, 'key' | 'keyId'>,
) => void;

/** A JWT (RFC 7519), signed with RS256 unless the header says otherwise. */
export function signedJwt(header: object, claims: object, key: KeyObject): string {
  const content = [header, claims]
    .map((part) => Buffer.from(JSON.stringify(part)).toString('base64url'))
    .join('.');
  return `${content}.${sign('sha256', Buffer.from(content), key).toString('base64url')}`;
}

export const CLIENT_ID = 'farpoint';

export class LoginProvider {
  readonly url: string;
  /** Signs its ID tokens. */
  readonly key = generateKeyPairSync('rsa', { modulusLength: 2048 }).privateKey;
  readonly keyId = randomUUID();
  readonly #server: Server;

  private constructor(server: Server, url: string) {
    this.#server = server;
    this.url = url;
  }

  static async start(options: LoginProviderOptions): Promise<LoginProvider> {
    const server = createServer();
    await new Promise<void>((resolve) => server.listen(options.port ?? 0, '127.0.0.1', resolve));
    const url = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
    const login = new LoginProvider(server, url);
    const jwk = { ...login.key.export({ format: 'jwk' }), kid: login.keyId, use: 'sig' } as JWK;
    const provider = new Provider(url, { ...configuration(options), jwks: { keys: [jwk] } });
    const { forge } = options;
    provider.use(async (context, next) => {
      await next();
      if (forge !== undefined && context.path === '/token' && context.status === 200)
        forge(context.body as Record<string, unknown>, login);
    });
    server.on('request', provider.callback());
    return login;
  }

  get port(): number {
    return Number(new URL(this.url).port);
  }

  close(): Promise<void> {
    return new Promise((resolve) => {
      this.#server.close(() => resolve());
      this.#server.closeAllConnections();
    });
  }
}

function configuration({
  people,
  callbackUrl,
  clientSecret = null,
  claimsInIdToken = true,
}: LoginProviderOptions): Configuration {
  return {
    clients: [
      {
        client_id: CLIENT_ID,
        redirect_uris: [callbackUrl],
        response_types: ['code'],
        grant_types: ['authorization_code'],
        // As for native programs: http on loopback.
        application_type: 'native',
        ...(clientSecret === null
          ? { token_endpoint_auth_method: 'none' }
          : { client_secret: clientSecret, token_endpoint_auth_method: 'client_secret_post' }),
      },
    ],
    claims: {
      openid: ['sub'],
      profile: ['name', 'groups', 'preferred_username'],
      email: ['email', 'email_verified'],
    },
    conformIdTokenClaims: !claimsInIdToken,
    pkce: { required: () => true },
    findAccount: (_context, sub) => {
      const claims = Object.hasOwn(people, sub) ? people[sub] : undefined;
      return claims === undefined ? undefined : { accountId: sub, claims: () => ({ sub, ...claims }) };
    },
    ttl: { Interaction: 600, Session: 600, Grant: 600, AuthorizationCode: 60, AccessToken: 60, IdToken: 60 },
    features: { devInteractions: { enabled: true } },
    cookies: { keys: ['only for tests'] },
  };
}
