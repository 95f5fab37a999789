/** The issuer's HTTP server: `/sign-in`, `/callback` and `/consent`, below the path of its public address. */
import { createServer, type IncomingMessage, type ServerResponse } from 'node:http';
import type { AddressInfo } from 'node:net';
import { listen, peerAddress, TrustedProxies } from '@farpoint/service';
import { BrowserCookie } from './browser-cookie.ts';
import { consentPage, consentPolicy } from './consent-page.ts';
import type { Reply, SignInDesk } from './sign-in-desk.ts';

export interface ServerOptions {
  readonly host: string;
  readonly port: number;
  /** The address by which browsers reach this server. */
  readonly url: string;
  /** The proxies whose `X-Forwarded-For` counts. */
  readonly trustProxy: readonly string[];
  /** Milliseconds since 1970. */
  readonly now: () => number;
  /** A fault of this program. The request gets no answer. */
  readonly onError: (error: unknown) => void;
}

/** Chosen: people sign in a few times a day, and a flood gets no more sockets than these. */
const MOST_CONNECTIONS = 1024;
/** Of a consent's form. Chosen: it has one token. */
const MOST_FORM_BYTES = 1024;
const METHODS = { '/sign-in': 'GET', '/callback': 'GET', '/consent': 'POST' } as const;
const NOTHING = { status: 404, text: 'Nothing here. Sign-ins begin on the operators’ page.' };

export interface RunningServer {
  readonly port: number;
  close(): Promise<void>;
}

type Refusal = { status: number; text: string };

/** @throws {Error} if it cannot listen on the address, for example EADDRINUSE */
export async function startServer(desk: SignInDesk, options: ServerOptions): Promise<RunningServer> {
  const { host, port, onError } = options;
  const office = new SignInOffice(desk, options);
  const server = createServer(
    {
      headersTimeout: 10_000,
      requestTimeout: 20_000,
      keepAliveTimeout: 5000,
      connectionsCheckingInterval: 2000,
    },
    (request, response) => {
      office
        .handle(request)
        .finally(() => request.resume())
        .then((reply) => office.answer(response, reply))
        .catch((error: unknown) => {
          onError(error);
          response.destroy();
        });
    },
  );
  server.maxConnections = MOST_CONNECTIONS;
  await listen(server, { host, port });
  return {
    port: (server.address() as AddressInfo).port,
    close: () =>
      new Promise((resolve) => {
        server.close(() => resolve());
        server.closeAllConnections();
      }),
  };
}

/** Puts requests to the desk, and its replies into HTTP. */
class SignInOffice {
  readonly #desk: SignInDesk;
  readonly #options: ServerOptions;
  readonly #base: string;
  readonly #cookie: BrowserCookie;
  readonly #headers: Readonly<Record<string, string>>;
  readonly #proxies: TrustedProxies;

  constructor(desk: SignInDesk, options: ServerOptions) {
    const { url, trustProxy } = options;
    const isHttps = url.startsWith('https:');
    this.#desk = desk;
    this.#options = options;
    this.#base = new URL(url).pathname.replace(/\/$/, '');
    this.#cookie = new BrowserCookie(isHttps);
    this.#headers = securityHeaders(isHttps);
    this.#proxies = new TrustedProxies(trustProxy);
  }

  async handle(request: IncomingMessage): Promise<Reply | Refusal> {
    const { now, url } = this.#options;
    const base = this.#base;
    // The host does not matter here: addresses of ours are made from the public one.
    const address = URL.parse(request.url ?? '', 'http://issuer');
    const path = address?.pathname.startsWith(`${base}/`) ? address.pathname.slice(base.length) : null;
    if (address === null || path === null || !Object.hasOwn(METHODS, path)) return NOTHING;
    const method = METHODS[path as keyof typeof METHODS];
    if (request.method !== method) return { status: 405, text: `Only ${method}.` };
    const caller = {
      address: peerAddress(request, this.#proxies),
      browser: this.#cookie.read(request.headers.cookie),
    };
    if (path === '/consent') {
      // Browsers say from which page a form comes. One of another site's would answer in the person's place.
      const { origin } = request.headers;
      if (origin !== undefined && origin !== new URL(url).origin)
        return { status: 403, text: 'This answer comes from another page.' };
      const form = await readForm(request);
      return form === null
        ? { status: 413, text: 'Too long.' }
        : await this.#desk.answer(form, caller, now());
    }
    return path === '/sign-in'
      ? await this.#desk.begin(address.searchParams, caller, now())
      : await this.#desk.finish(address.searchParams, caller, now());
  }

  answer(response: ServerResponse, reply: Reply | Refusal): void {
    const headers = this.#headers;
    if ('redirect' in reply) {
      const owned = reply.browser === undefined ? {} : { 'set-cookie': this.#cookie.write(reply.browser) };
      response.writeHead(303, { ...headers, ...owned, location: reply.redirect }).end();
      return;
    }
    if ('consent' in reply) {
      const { consent, browser } = reply;
      const page = consentPage(consent, `${this.#base}/consent`);
      const own = {
        'content-security-policy': consentPolicy(consent.page),
        // With none at all, browsers do not say either from which page the answer comes.
        'referrer-policy': 'same-origin',
        // The cookie ends no earlier than the question.
        'set-cookie': this.#cookie.write(browser),
        'content-type': 'text/html; charset=utf-8',
        'content-length': Buffer.byteLength(page),
      };
      response.writeHead(200, { ...headers, ...own }).end(page);
      return;
    }
    const body = `${reply.text}\n`;
    const { status } = reply;
    const more = {
      ...(status === 405 ? { allow: reply.text.includes('POST') ? 'POST' : 'GET' } : {}),
      ...(status === 429 ? { 'retry-after': '60' } : {}),
    };
    const length = { 'content-type': 'text/plain; charset=utf-8', 'content-length': Buffer.byteLength(body) };
    response.writeHead(status, { ...headers, ...more, ...length }).end(body);
  }
}

function securityHeaders(isHttps: boolean): Readonly<Record<string, string>> {
  return {
    'cache-control': 'no-store',
    'content-security-policy':
      "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    'cross-origin-opener-policy': 'same-origin',
    'cross-origin-resource-policy': 'same-origin',
    // The addresses have codes in them.
    'referrer-policy': 'no-referrer',
    'x-content-type-options': 'nosniff',
    'x-frame-options': 'DENY',
    ...(isHttps ? { 'strict-transport-security': 'max-age=31536000' } : {}),
  };
}

/** @returns `null` if it is too long */
async function readForm(request: IncomingMessage): Promise<URLSearchParams | null> {
  let text = '';
  for await (const part of request.setEncoding('utf8')) {
    text += String(part);
    if (text.length > MOST_FORM_BYTES) return null;
  }
  return new URLSearchParams(text);
}
