/** The cookie that ties a sign-in to the browser in which it began. */
import { SIGN_IN_TIME_MS } from './pending-sign-ins.ts';

const SECRET = /^[A-Za-z0-9_-]{43}$/;

export class BrowserCookie {
  readonly #name: string;
  readonly #secure: boolean;

  /** @param secure whether the issuer is reached by https */
  constructor(secure: boolean) {
    this.#secure = secure;
    // With this prefix, no other host can set it (RFC 6265bis, section 4.1.3.2).
    this.#name = secure ? '__Host-farpoint-sign-in' : 'farpoint-sign-in';
  }

  /** @returns the browser's secret; `null` if it has none */
  read(header: string | undefined): string | null {
    for (const part of (header ?? '').split(';')) {
      const [name, value = ''] = part.trim().split('=', 2);
      if (name === this.#name && SECRET.test(value)) return value;
    }
    return null;
  }

  /** @returns the value of a `Set-Cookie` header */
  write(secret: string): string {
    const seconds = SIGN_IN_TIME_MS / 1000;
    return `${this.#name}=${secret}; Path=/; Max-Age=${seconds}; HttpOnly; SameSite=Lax${this.#secure ? '; Secure' : ''}`;
  }
}
