/** What a browser does in a sign-in: follows redirects, keeps cookies and fills in forms. */

export interface Page {
  url: URL;
  status: number;
  text: string;
}

export class WebBrowser {
  /** By origin, by name. */
  readonly #cookies = new Map<string, Map<string, string>>();
  /** It stops at addresses that begin with one of these, instead of fetching them. */
  stopAt: readonly string[];

  constructor(stopAt: readonly string[]) {
    this.stopAt = stopAt;
  }

  /** Follows redirects until a page or the address to stop at. */
  async open(address: string, form?: Record<string, string>): Promise<Page> {
    let url = new URL(address);
    let body = form === undefined ? undefined : new URLSearchParams(form);
    for (let hops = 0; hops < 20; hops++) {
      if (this.stopAt.some((each) => url.href.startsWith(each))) return { url, status: 0, text: '' };
      const response = await fetch(url, {
        ...{ redirect: 'manual', headers: { cookie: this.#cookieHeader(url.origin) } },
        ...(body === undefined ? {} : { method: 'POST', body }),
      });
      this.#keep(url.origin, response.headers.getSetCookie());
      const location = response.headers.get('location');
      if (location === null) return { url, status: response.status, text: await response.text() };
      await response.body?.cancel();
      url = new URL(location, url);
      body = undefined;
    }
    throw new Error(`too many redirects, at ${url.href}`);
  }

  /**
   * Signs in at the provider's form, and consents, there and at the issuer.
   *
   * @returns the page after it
   */
  async signIn(address: string, name: string): Promise<Page> {
    return await this.allow(await this.signInAtProvider(address, name));
  }

  /** Answers the issuer's question, if it asks one. */
  async allow(page: Page, answer: 'yes' | 'no' = 'yes'): Promise<Page> {
    const token = / name="token" value="([^"]+)"/.exec(page.text)?.[1];
    return token === undefined ? page : await this.open(actionOf(page), { token, answer });
  }

  /** @returns the page after the provider's forms: the issuer's question */
  async signInAtProvider(address: string, name: string): Promise<Page> {
    const form = await this.open(address);
    const consent = await this.open(actionOf(form), { prompt: 'login', login: name, password: 'any' });
    return consent.text.includes('<form')
      ? await this.open(actionOf(consent), { prompt: 'consent' })
      : consent;
  }

  #cookieHeader(origin: string): string {
    return [...(this.#cookies.get(origin) ?? [])].map(([name, value]) => `${name}=${value}`).join('; ');
  }

  #keep(origin: string, setCookies: readonly string[]): void {
    const kept = this.#cookies.get(origin) ?? new Map<string, string>();
    for (const line of setCookies) {
      const [, name = '', value = ''] = /^([^=]+)=([^;]*)/.exec(line) ?? [];
      if (value === '') kept.delete(name);
      else kept.set(name, value);
    }
    this.#cookies.set(origin, kept);
  }
}

function actionOf({ url, text }: Page): string {
  const action = /<form[^>]* action="([^"]+)"/.exec(text)?.[1];
  if (action === undefined) throw new Error(`no form at ${url.href}: ${text.slice(0, 500)}`);
  return new URL(action, url).href;
}
