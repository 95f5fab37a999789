import { type AddressInfo, createServer } from 'node:net';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';
import { LoggingProcess } from './testing/logging-process.ts';

const program = fileURLToPath(new URL('./program.fixture.ts', import.meta.url));
const start = (args: string[]) => new LoggingProcess(program, args);

test('runs, serves health, stops in order on SIGTERM with exit code 0', async () => {
  const fixture = start(['--admin-port', '0']);
  const { port } = await fixture.logged('health and metrics');
  expect((await fetch(`http://127.0.0.1:${String(port)}/healthz`)).status).toBe(200);
  await fixture.logged('up');
  fixture.child.kill('SIGTERM');
  await fixture.logged('closed the fixture');
  expect(await fixture.exited).toBe(0);
});

test('a mistake in the options is one sentence on standard error and exit code 2', async () => {
  const fixture = start(['--admin-port', 'x']);
  expect(await fixture.exited).toBe(2);
  expect(fixture.errors).toBe(
    'farpoint-robot: --admin-port must be a whole number from 0 to 65535, not "x"\n',
  );
});

test('a port that is in use is one line with what to do, without a stack, and exit code 1', async () => {
  const server = createServer();
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address() as AddressInfo;
  const fixture = start(['--admin-port', String(port)]);
  const said = await fixture.logged(/^could not start: /);
  expect(await fixture.exited).toBe(1);
  server.close();
  expect(said).toMatchObject({
    level: 'fatal',
    msg: expect.stringContaining(`127.0.0.1:${port} is already used by `) as string,
    remedy: 'set --admin-port to another port, or stop that program',
  });
  expect(said).not.toHaveProperty('err');
});

test('an uncaught exception ends the program in order with exit code 1', async () => {
  const fixture = start(['--admin-port', '0', '--fail']);
  await fixture.logged('unhandled rejection');
  await fixture.logged('closed the fixture');
  expect(await fixture.exited).toBe(1);
});
