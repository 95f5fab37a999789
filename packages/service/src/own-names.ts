/**
 * The names by which browsers may ask for a service. Whoever owns another name can let it point to this machine (DNS
 * rebinding): the browser then takes the service for a part of that owner's site, and lets its pages read the answers.
 */
import type { IncomingMessage, ServerResponse } from 'node:http';
import { isIP } from 'node:net';
import { hostname } from 'node:os';

/** Endings that nobody can register: of local networks. */
const LOCAL_ENDINGS = ['', '.local', '.lan', '.home.arpa', '.internal'];

/** This machine's names, and those that it is told. */
export function ownNames(more: readonly string[] = [], machine: string = hostname()): ReadonlySet<string> {
  const own = machine.toLowerCase();
  const [short = own] = own.split('.');
  return new Set([own, ...LOCAL_ENDINGS.map((ending) => short + ending), ...more.map(plainName)]);
}

/**
 * Whether a `Host` header names this machine. An address always does: nobody but this machine answers for it, and pages of
 * that origin come from here. No browser leaves the header out.
 */
export function isOwnHost(host: string | undefined, names: ReadonlySet<string>): boolean {
  if (host === undefined) return true;
  const name = hostName(host);
  if (name === null) return false;
  const isAddress = name.startsWith('[') || isIP(name) !== 0;
  return isAddress || name === 'localhost' || name.endsWith('.localhost') || names.has(name);
}

/** Answers a request that names another host. @returns whether it did */
export function refusesHost(
  request: IncomingMessage,
  response: ServerResponse,
  names: ReadonlySet<string>,
  option: string,
): boolean {
  const { host } = request.headers;
  if (isOwnHost(host, names)) return false;
  const body = `${hostRefusal(host, option)}\n`;
  response.writeHead(421, {
    'content-type': 'text/plain; charset=utf-8',
    'content-length': Buffer.byteLength(body),
    'cache-control': 'no-store',
    'x-content-type-options': 'nosniff',
    connection: 'close',
  });
  response.end(request.method === 'HEAD' ? undefined : body);
  return true;
}

/** @param option that would allow it */
export function hostRefusal(host: string | undefined, option: string): string {
  const name = hostName(host ?? '') ?? '';
  return `this program does not know itself as ${JSON.stringify(name.slice(0, 100))}: if it is a name of this machine, set ${option}`;
}

/** Without port and final dot, in lower case; `null` if it is none. */
function hostName(host: string): string | null {
  if (/[/@?#\\\s]/.test(host)) return null;
  const name = URL.parse(`http://${host}/`)?.hostname;
  return name === undefined || name === '' ? null : plainName(name);
}

function plainName(name: string): string {
  return name.toLowerCase().replace(/\.$/, '');
}
