import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';

const program = fileURLToPath(new URL('./program.fixture.ts', import.meta.url));

function start(args: string[]) {
  const child = spawn(process.execPath, [program, ...args], { stdio: ['ignore', 'pipe', 'pipe'] });
  let errors = '';
  child.stderr.on('data', (data: Buffer) => {
    errors += data.toString();
  });
  const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
  return {
    child,
    errors: () => errors,
    exited: once(child, 'close').then(([code]) => code as number),
    async logged(message: string): Promise<Record<string, unknown>> {
      for (;;) {
        const line = await lines.next();
        if (line.done === true) throw new Error(`never logged: ${message}`);
        const record = JSON.parse(line.value) as Record<string, unknown>;
        if (record.msg === message) return record;
      }
    },
  };
}

test('runs, serves health, stops in order on SIGTERM with exit code 0', async () => {
  const { child, logged, exited } = start(['--admin-port', '0']);
  const { port } = await logged('health and metrics');
  expect((await fetch(`http://127.0.0.1:${String(port)}/healthz`)).status).toBe(200);
  await logged('up');
  child.kill('SIGTERM');
  await logged('closed the fixture');
  expect(await exited).toBe(0);
});

test('a mistake in the options is one sentence on standard error and exit code 2', async () => {
  const { errors, exited } = start(['--admin-port', 'x']);
  expect(await exited).toBe(2);
  expect(errors()).toBe('farpoint-robot: --admin-port must be a whole number from 0 to 65535, not "x"\n');
});

test('an exception nobody caught ends the program in order with exit code 1', async () => {
  const { logged, exited } = start(['--admin-port', '0', '--fail']);
  await logged('unhandled rejection');
  await logged('closed the fixture');
  expect(await exited).toBe(1);
});
