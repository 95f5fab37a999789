import { createServer, type IncomingMessage, type ServerResponse } from 'node:http';
import type { AddressInfo, Server } from 'node:net';
import { collectDefaultMetrics, Registry } from 'prom-client';
import type { Health } from './health.ts';
import { ownNames, refusesHost } from './own-names.ts';

export { Counter, Gauge, Histogram, Registry } from 'prom-client';

/**
 * The event loop's delay is measured by a timer of this period, ms: what it finds is the period and the delay. Each time
 * wakes a process that has nothing else to do.
 */
const EVENT_LOOP_PERIOD_MS = 25;

/** A new registry with metrics of the process's memory, CPU, event-loop delay and garbage collection. */
export function createMetrics(): Registry {
  const registry = new Registry();
  collectDefaultMetrics({ register: registry, eventLoopMonitoringPrecision: EVENT_LOOP_PERIOD_MS });
  return registry;
}

/**
 * Answers `/healthz` and `/metrics`; returns false for any other path, without doing anything.
 *
 * @param shows `status`: for strangers: how `/healthz` is, without anything else, and no `/metrics`
 */
export type AdminHandler = (
  request: IncomingMessage,
  response: ServerResponse,
  shows?: 'all' | 'status',
) => boolean;

/** The handler to mount on a program's own HTTP server. */
export function createAdminHandler(health: Health, metrics: Registry): AdminHandler {
  return (request, response, shows = 'all') => {
    const path = request.url?.split('?', 1)[0];
    if (path !== '/healthz' && (path !== '/metrics' || shows === 'status')) return false;
    if (request.method !== 'GET' && request.method !== 'HEAD') {
      reply(request, response, 405, 'text/plain; charset=utf-8', 'only GET and HEAD\n', {
        allow: 'GET, HEAD',
      });
      return true;
    }
    if (path === '/healthz') {
      const report = health.report();
      reply(
        request,
        response,
        report.status === 'ok' ? 200 : 503,
        'application/json; charset=utf-8',
        `${JSON.stringify(shows === 'all' ? report : { status: report.status })}\n`,
      );
    } else {
      metrics.metrics().then(
        (text) => reply(request, response, 200, metrics.contentType, text),
        (error: unknown) =>
          reply(request, response, 500, 'text/plain; charset=utf-8', `metrics failed: ${String(error)}\n`),
      );
    }
    return true;
  };
}

export interface AdminAddress {
  host: string;
  port: number;
  /** Names of this machine, besides those that it knows. */
  names?: readonly string[];
}

export interface AdminServer {
  readonly port: number;
  close(): Promise<void>;
}

/**
 * An HTTP server with nothing but health and metrics, for programs without an HTTP server of their own.
 *
 * @throws {Error} if it cannot listen on the address, for example EADDRINUSE
 */
export async function startAdminServer(
  handler: AdminHandler,
  { names, ...address }: AdminAddress,
): Promise<AdminServer> {
  const own = ownNames(names);
  const server = createServer((request, response) => {
    if (refusesHost(request, response, own, '--admin-names')) return;
    if (!handler(request, response)) {
      reply(request, response, 404, 'text/plain; charset=utf-8', 'this port serves /healthz and /metrics\n');
    }
  });
  await listen(server, address);
  return {
    port: (server.address() as AddressInfo).port,
    close: () =>
      new Promise((resolve) => {
        server.close(() => resolve());
        server.closeAllConnections();
      }),
  };
}

function reply(
  request: IncomingMessage,
  response: ServerResponse,
  status: number,
  contentType: string,
  body: string,
  headers: Record<string, string> = {},
): void {
  response.writeHead(status, {
    'content-type': contentType,
    'content-length': Buffer.byteLength(body),
    'cache-control': 'no-store',
    'x-content-type-options': 'nosniff',
    ...headers,
  });
  response.end(request.method === 'HEAD' ? undefined : body);
}

/** Resolves once a server listens. @throws {Error} if it cannot, for example EADDRINUSE */
export function listen(server: Server, address: { host: string; port: number }): Promise<void> {
  return new Promise((resolve, reject) => {
    server.once('error', reject);
    server.listen(address.port, address.host, () => {
      server.off('error', reject);
      resolve();
    });
  });
}
