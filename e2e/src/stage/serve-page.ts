/** Serves the page that `pnpm build` has made for tests, and the clouds of its scripted robot. No robot, no signaling. */
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import { cloudFile } from './cloud-files.ts';

const FOLDER = join(repositoryRoot, 'apps/webxr/dist-testing');
const CLOUD = /^\/stage\/clouds\/([\w-]+)\.json$/;
const TYPES: Readonly<Record<string, string>> = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.wasm': 'application/wasm',
  '.json': 'application/json',
  '.map': 'application/json',
};

export interface PageServer {
  /** Without a slash at its end. */
  origin: string;
  close(): Promise<void>;
}

/** @param extra answers further paths with HTML; `null`: none of them @param port 0: any that is free */
export async function servePage(
  extra: (path: string) => string | null = () => null,
  port = 0,
): Promise<PageServer> {
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? '/', 'http://localhost');
    void answer(pathname, extra).then((file) => {
      if (file === null) return response.writeHead(404).end();
      return response
        .writeHead(200, { 'content-type': file.type, 'cache-control': 'no-cache' })
        .end(file.body);
    });
  });
  await new Promise<void>((resolve, reject) => {
    server.once('error', reject);
    server.listen(port, '127.0.0.1', resolve);
  });
  const { port: taken } = server.address() as AddressInfo;
  return {
    origin: `http://127.0.0.1:${taken}`,
    close: () =>
      new Promise((resolve) => {
        server.closeAllConnections();
        server.close(() => resolve());
      }),
  };
}

async function answer(
  pathname: string,
  extra: (path: string) => string | null,
): Promise<{ type: string; body: string | Uint8Array } | null> {
  const html = extra(pathname);
  if (html !== null) return { type: TYPES['.html'] ?? '', body: html };
  const cloud = CLOUD.exec(pathname)?.[1];
  if (cloud !== undefined) {
    const json = await cloudFile(cloud);
    return json === null ? null : { type: TYPES['.json'] ?? '', body: json };
  }
  const path = normalize(pathname === '/' ? '/index.html' : pathname);
  const type = TYPES[extname(path)];
  if (type === undefined || path.includes('..')) return null;
  return readFile(join(FOLDER, path)).then(
    (body) => ({ type, body }),
    () => null,
  );
}
