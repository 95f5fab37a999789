import { existsSync } from 'node:fs';
import type { IncomingMessage, ServerResponse } from 'node:http';
import { join } from 'node:path';
import { OptionsError } from '@farpoint/service';
import sirv from 'sirv';

/** Other servers that the page may use, besides the one that serves it. */
export interface PageServers {
  /** A map's tiles. */
  readonly mapOrigins: readonly string[];
  /** WebSockets: other signaling services, a Janus. */
  readonly connectOrigins: readonly string[];
}

/** Bridges run on the operator's own machine. */
const OWN_MACHINE = ['ws://localhost:*', 'ws://127.0.0.1:*'];

const contentSecurityPolicy = ({ mapOrigins, connectOrigins }: PageServers) =>
  [
    "default-src 'self'",
    "script-src 'self' 'wasm-unsafe-eval'",
    "worker-src 'self' blob:",
    ["connect-src 'self' blob: data:", ...OWN_MACHINE, ...connectOrigins].join(' '),
    ["img-src 'self' data: blob:", ...mapOrigins].join(' '),
    "media-src 'self' blob:",
    "style-src 'self' 'unsafe-inline'",
    "object-src 'none'",
    "base-uri 'none'",
    "frame-ancestors 'self'",
  ].join('; ');

/**
 * Serves a built web app; calls `next` for paths that are not in it. The folder is read once: restart after a new
 * build.
 *
 * @param servers other servers that the page may use
 */
export function webRoot(
  folder: string,
  servers: PageServers = { mapOrigins: [], connectOrigins: [] },
): (request: IncomingMessage, response: ServerResponse, next: () => void) => void {
  if (!existsSync(join(folder, 'index.html'))) {
    throw new OptionsError(
      '--web-root',
      `names a folder without index.html: ${folder} (build the web app first)`,
    );
  }
  const policy = contentSecurityPolicy(servers);
  return sirv(folder, {
    etag: true,
    // Where the build has left compressed files beside the others.
    brotli: true,
    gzip: true,
    setHeaders(response, path) {
      // File names under assets/ carry a hash of the content.
      const fixed = path.startsWith('/assets/');
      response.setHeader('Cache-Control', fixed ? 'public, max-age=31536000, immutable' : 'no-cache');
      response.setHeader('X-Content-Type-Options', 'nosniff');
      response.setHeader('Referrer-Policy', 'no-referrer');
      response.setHeader('Content-Security-Policy', policy);
      response.setHeader('Permissions-Policy', 'xr-spatial-tracking=(self), gamepad=(self)');
      // Cross-origin isolation allows precise clocks and shared memory.
      response.setHeader('Cross-Origin-Opener-Policy', 'same-origin');
      response.setHeader('Cross-Origin-Embedder-Policy', 'require-corp');
      response.setHeader('Cross-Origin-Resource-Policy', 'same-origin');
    },
  });
}
