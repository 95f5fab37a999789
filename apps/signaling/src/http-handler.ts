import type { IncomingMessage, RequestListener } from 'node:http';
import { isLoopbackHost } from '@farpoint/protocol';
import { type createAdminHandler, plainAddress, refusesHost } from '@farpoint/service';
import type { SignalingOptions } from './options.ts';
import { webRoot } from './web-root.ts';

type HttpOptions = Pick<SignalingOptions, 'webRoot' | 'mapOrigins' | 'connectOrigins' | 'publicMetrics'>;

/** Refuses requests for names that are not the service's own. @param names `null`: for no name */
export function forOwnNames(http: RequestListener, names: ReadonlySet<string> | null): RequestListener {
  if (names === null) return http;
  return (request, response) => {
    if (!refusesHost(request, response, names, '--public-names')) http(request, response);
  };
}

/** Serves health and metrics, then the files of the web root if there is one, otherwise 404. */
export function httpHandler(
  admin: ReturnType<typeof createAdminHandler>,
  options: HttpOptions,
): RequestListener {
  const { webRoot: folder, publicMetrics } = options;
  const files = folder === null ? null : webRoot(folder, options);
  return (request, response) => {
    const isHidden = request.url?.split('?', 1)[0] === '/metrics' && !publicMetrics && !isOwnMachine(request);
    if (isHidden) return notFound(request, response);
    if (admin(request, response)) return;
    if (files === null) notFound(request, response);
    else files(request, response, () => notFound(request, response));
  };
}

/** A proxy on this machine passes on what others ask. */
function isOwnMachine(request: IncomingMessage): boolean {
  const { headers } = request;
  const isForwarded = headers['x-forwarded-for'] !== undefined || headers.forwarded !== undefined;
  return !isForwarded && isLoopbackHost(plainAddress(request.socket.remoteAddress ?? ''));
}

export const notFound: RequestListener = (_request, response) => {
  response.writeHead(404, {
    'content-type': 'text/plain; charset=utf-8',
    'x-content-type-options': 'nosniff',
  });
  response.end('nothing here\n');
};
