import type { RequestListener } from 'node:http';
import { isIP } from 'node:net';

/** For how long browsers use HTTPS only, seconds: a year, as browsers' own lists require at least. */
const MAX_AGE_S = 31_536_000;

/**
 * Tells browsers to use this host by HTTPS only (RFC 6797), so that nobody on the way can keep a page on HTTP. For use
 * behind TLS only. `localhost` is left alone: the rule is for all ports of a host, and other programs use it, too.
 */
export function strictTransport(handler: RequestListener): RequestListener {
  return (request, response) => {
    const name = hostName(request.headers.host);
    if (name !== null && !isLocal(name))
      response.setHeader('strict-transport-security', `max-age=${MAX_AGE_S}`);
    handler(request, response);
  };
}

function hostName(host: string | undefined): string | null {
  return host === undefined ? null : (URL.parse(`https://${host}`)?.hostname ?? null);
}

/** Browsers ignore the rule for addresses (RFC 6797, 8.1.1). */
function isLocal(name: string): boolean {
  return name === 'localhost' || name.endsWith('.localhost') || name.startsWith('[') || isIP(name) !== 0;
}
