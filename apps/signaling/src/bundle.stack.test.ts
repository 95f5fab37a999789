import { spawnSync } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { LoggingProcess } from '@farpoint/service/testing';
import { useFolder } from '@farpoint/service/testing/folder';
import { beforeAll, expect, test } from 'vitest';
import { TestSocket } from './test-sockets.ts';

const folder = useFolder();
const bundle = join(folder, 'signaling.mjs');

beforeAll(() => {
  const built = spawnSync(process.execPath, [resolve(import.meta.dirname, '../build.ts'), bundle]);
  if (built.status !== 0) throw new Error(built.stderr.toString());
}, 60_000);

const start = (args: string[]) =>
  new LoggingProcess(bundle, args, { cwd: folder, env: { PATH: process.env.PATH } });

const anyPorts = ['--port', '0', '--reference-robot-port', '0', '--reference-client-port', '0'];

test('runs alone, serves, and at SIGTERM tells its peers and exits with 0', async () => {
  expect(readdirSync(folder)).toEqual(['signaling.mjs']);
  const service = start(anyPorts);
  const { signaling } = await service.logged('listening');
  expect((await fetch(`http://127.0.0.1:${String(signaling)}/healthz`)).status).toBe(200);
  const robot = await TestSocket.open(`ws://127.0.0.1:${String(signaling)}/robot`);
  robot.send({ type: 'robot.hello', protocol: 1, id: 'r1', name: 'R', key: 'k' });
  await robot.until('robot.welcome');
  service.child.kill('SIGHUP'); // nothing to read again, nothing lost
  await service.logged('reloaded certificate and tokens');
  service.child.kill('SIGTERM');
  expect(await robot.until('error')).toMatchObject({ code: 'shutting-down' });
  expect((await robot.closed).code).toBe(1012);
  expect(await service.exited).toBe(0);
});

test('reports a missing file in one sentence, with exit code 2', async () => {
  const service = start([...anyPorts, '--robot-tokens', '/nix']);
  expect(await service.exited).toBe(2);
  expect(service.errors).toMatch(
    /^farpoint-signaling: --robot-tokens cannot be read: .* does not exist.*\n$/,
  );
});
