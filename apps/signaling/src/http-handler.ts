import { createHash, timingSafeEqual } from 'node:crypto';
import type { IncomingMessage, RequestListener } from 'node:http';
import { type createAdminHandler, refusesHost, type Secret } from '@farpoint/service';
import type { SignalingOptions } from './options.ts';
import { webRoot } from './web-root.ts';

type HttpOptions = Pick<
  SignalingOptions,
  'webRoot' | 'mapOrigins' | 'connectOrigins' | 'publicMetrics' | 'metricsToken'
>;

/** Refuses requests for names that are not the service's own. @param names `null`: for no name */
export function forOwnNames(http: RequestListener, names: ReadonlySet<string> | null): RequestListener {
  if (names === null) return http;
  return (request, response) => {
    if (!refusesHost(request, response, names, '--public-names')) http(request, response);
  };
}

/**
 * Serves health and, to whoever may read them, its details and metrics; then the files of the web root if there is one, otherwise
 * 404. Where a request comes from says nothing: a proxy on this machine passes on what strangers ask, and need not say so.
 */
export function httpHandler(
  admin: ReturnType<typeof createAdminHandler>,
  options: HttpOptions,
): RequestListener {
  const { webRoot: folder, publicMetrics, metricsToken } = options;
  const files = folder === null ? null : webRoot(folder, options);
  return (request, response) => {
    const mayRead = publicMetrics || (metricsToken !== null && shows(request, metricsToken));
    if (admin(request, response, mayRead ? 'all' : 'status')) return;
    if (files === null) notFound(request, response);
    else files(request, response, () => notFound(request, response));
  };
}

/** Whether a request has the token. In a time that does not depend on how much of it is right. */
function shows(request: IncomingMessage, token: Secret): boolean {
  const [, shown = ''] = /^Bearer (.+)$/i.exec(request.headers.authorization ?? '') ?? [];
  const digest = (text: string) => createHash('sha256').update(text).digest();
  return timingSafeEqual(digest(shown), digest(token.reveal()));
}

export const notFound: RequestListener = (_request, response) => {
  response.writeHead(404, {
    'content-type': 'text/plain; charset=utf-8',
    'x-content-type-options': 'nosniff',
  });
  response.end('nothing here\n');
};
