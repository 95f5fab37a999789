import { request } from 'node:http';
import { afterEach, expect, test } from 'vitest';
import {
  type AdminServer,
  Counter,
  createAdminHandler,
  createMetrics,
  startAdminServer,
} from './admin-server.ts';
import { Health } from './health.ts';

let server: AdminServer | null = null;
afterEach(async () => {
  await server?.close();
  server = null;
});

async function start(health: Health) {
  const metrics = createMetrics();
  server = await startAdminServer(createAdminHandler(health, metrics), { host: '127.0.0.1', port: 0 });
  const { port } = server;
  return {
    metrics,
    get: (path: string, init?: RequestInit) => fetch(`http://127.0.0.1:${port}${path}`, init),
  };
}

async function statusOf(response: Response): Promise<string> {
  return ((await response.json()) as { status: string }).status;
}

test('/healthz is 200 while every check is ok, 503 once one fails or the program shuts down', async () => {
  let now = 0;
  const health = new Health(() => now);
  let ok = true;
  health.add('camera', () => ({ ok, detail: { framesPerSecond: ok ? 30 : 0 } }));
  const { get } = await start(health);
  now = 61_400;
  const well = await get('/healthz?x=1');
  expect([well.status, await well.json()]).toEqual([
    200,
    { status: 'ok', uptimeSeconds: 61, checks: { camera: { ok: true, detail: { framesPerSecond: 30 } } } },
  ]);
  ok = false;
  const ill = await get('/healthz');
  expect([ill.status, await statusOf(ill)]).toEqual([503, 'failing']);
  ok = true;
  health.stopping();
  const stopping = await get('/healthz');
  expect([stopping.status, await statusOf(stopping)]).toEqual([503, 'stopping']);
});

test('a check that throws is a failing check', () => {
  const health = new Health();
  health.add('disk', () => {
    throw new Error('gone');
  });
  expect(health.report()).toMatchObject({
    status: 'failing',
    checks: { disk: { ok: false, detail: 'gone' } },
  });
});

test('/metrics has Prometheus format, with metrics of the process', async () => {
  const { get, metrics } = await start(new Health());
  new Counter({ name: 'farpoint_test_total', help: 'x', registers: [metrics] }).inc(3);
  const response = await get('/metrics');
  expect(response.headers.get('content-type')).toContain('text/plain');
  const text = await response.text();
  expect(text).toContain('farpoint_test_total 3');
  expect(text).toContain('process_resident_memory_bytes');
});

test('other paths 404, other methods 405, HEAD without a body', async () => {
  const { get } = await start(new Health());
  expect((await get('/')).status).toBe(404);
  expect((await get('/healthz', { method: 'POST', body: 'x' })).status).toBe(405);
  const head = await get('/healthz', { method: 'HEAD' });
  expect([head.status, await head.text()]).toEqual([200, '']);
});

test('is asked only by names of this machine', async () => {
  const handler = createAdminHandler(new Health(), createMetrics());
  server = await startAdminServer(handler, { host: '127.0.0.1', port: 0, names: ['robot.example'] });
  const { port } = server;
  const status = (host: string) =>
    new Promise<number | undefined>((resolve, reject) => {
      request({ port, path: '/metrics', host: '127.0.0.1', headers: { host } }, (response) => {
        response.resume();
        resolve(response.statusCode);
      })
        .on('error', reject)
        .end();
    });
  expect(await status('evil.example')).toBe(421);
  expect(await status(`localhost:${port}`)).toBe(200);
  expect(await status('robot.example')).toBe(200);
});

test('a port that is in use is an error', async () => {
  await start(new Health());
  const handler = createAdminHandler(new Health(), createMetrics());
  await expect(startAdminServer(handler, { host: '127.0.0.1', port: server!.port })).rejects.toThrow(
    'EADDRINUSE',
  );
});
