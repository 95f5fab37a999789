import type { RequestListener } from 'node:http';
import type { createAdminHandler } from '@farpoint/service';
import { webRoot } from './web-root.ts';

/** Serves health and metrics, then the files of `folder` if given, otherwise 404. */
export function httpHandler(
  admin: ReturnType<typeof createAdminHandler>,
  folder: string | null,
  imageOrigins: readonly string[] = [],
): RequestListener {
  const files = folder === null ? null : webRoot(folder, imageOrigins);
  return (request, response) => {
    if (admin(request, response)) return;
    if (files === null) notFound(request, response);
    else files(request, response, () => notFound(request, response));
  };
}

export const notFound: RequestListener = (_request, response) => {
  response.writeHead(404, {
    'content-type': 'text/plain; charset=utf-8',
    'x-content-type-options': 'nosniff',
  });
  response.end('nothing here\n');
};
