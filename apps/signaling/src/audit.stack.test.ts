/** What the running service writes to its audit log, and what it does not write to any log. */
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { auditCommand } from '@farpoint/audit';
import { LoggingProcess } from '@farpoint/service/testing';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, test } from 'vitest';
import { TestSocket } from './test-sockets.ts';

const folder = useFolder();
const file = join(folder, 'audit.jsonl');
const [robotTokens, operatorTokens] = [join(folder, 'robots.yaml'), join(folder, 'operators.txt')];
writeFileSync(robotTokens, 'r1: token-of-r1\n');
writeFileSync(operatorTokens, 'operator-token\n');

interface Entry {
  kind: string;
  session?: string;
  robot?: string;
  subject?: object;
  details: Record<string, unknown>;
}

test('connections with the names of their tokens, sessions and refusals; no secret', async () => {
  const main = join(import.meta.dirname, 'main.ts');
  const args = ['--port', '0', '--audit-log', file, '--max-faults', '2'];
  const tokens = ['--robot-tokens', robotTokens, '--operator-tokens', operatorTokens];
  const service = new LoggingProcess(main, [...args, ...tokens], {
    env: { ...process.env, FARPOINT_SIGNALING_TURN_SECRET: 'turn-secret' },
  });
  let output = '';
  service.child.stdout?.on('data', (data: Buffer) => {
    output += data.toString();
  });
  const { signaling } = await service.logged('listening');
  const open = (path: string) => TestSocket.open(`ws://127.0.0.1:${String(signaling)}${path}`);
  const robot = await open('/robot');
  robot.send({
    type: 'robot.hello',
    protocol: 1,
    id: 'r1',
    name: 'R',
    key: 'robot-key',
    token: 'token-of-r1',
  });
  await robot.until('robot.welcome');
  const operator = await open('/operator');
  operator.send({ type: 'operator.hello', protocol: 1, name: 'Ada', token: 'operator-token' });
  await operator.until('robots');
  operator.send({ type: 'session.open', robotId: 'r1' });
  const handle = String((await operator.until('session.opened')).session);
  operator.send({ type: 'session.close', session: handle });
  await robot.until('session.closed');
  const stranger = await open('/operator');
  stranger.send({ type: 'operator.hello', protocol: 1, name: 'Eve', token: 'guessed-token' });
  await stranger.until('error');
  operator.socket.close();
  await operator.closed;
  service.child.kill('SIGTERM');
  expect(await service.exited).toBe(0);

  const text = readFileSync(file, 'utf8');
  const entries = text
    .trimEnd()
    .split('\n')
    .map((line) => JSON.parse(line) as Entry);
  expect(
    entries.map(({ kind, robot: id, subject, details }) => ({ kind, id, subject, ...details })),
  ).toMatchObject([
    { kind: 'started', configuration: { turnSecret: 'set', auditLog: file } },
    { kind: 'connected', as: 'robot', id: 'r1', token: expect.stringMatching(/^[0-9a-f]{12}$/) },
    { kind: 'connected', as: 'operator', subject: { name: 'Ada', proven: false }, address: '127.0.0.1' },
    { kind: 'session-began', id: 'r1', subject: { name: 'Ada', proven: false } },
    { kind: 'session-ended', reason: 'closed-by-operator' },
    { kind: 'refused', what: 'operator', reason: 'unauthorized' },
    { kind: 'disconnected', as: 'operator', subject: { name: 'Ada' } },
    { kind: 'disconnected', as: 'robot', id: 'r1' },
    { kind: 'stopped' },
  ]);
  const secrets = ['token-of-r1', 'operator-token', 'guessed-token', 'turn-secret', 'robot-key', handle];
  for (const secret of secrets) {
    expect(text).not.toContain(secret);
    expect(output).not.toContain(secret);
  }
  expect(output).toContain(entries[3]!.session);

  const rim = { stdout: { write: () => true }, stderr: process.stderr };
  expect(auditCommand('farpoint-signaling', ['verify', file], rim)).toBe(0);
});

test('a file that cannot be opened is a mistake in the options', async () => {
  const service = new LoggingProcess(join(import.meta.dirname, 'main.ts'), [
    ...['--port', '0', '--audit-log', join(folder, 'no', 'audit')],
  ]);
  expect(await service.exited).toBe(2);
  expect(service.errors).toMatch(/^farpoint-signaling: --audit-log cannot be opened: .* does not exist\n$/);
});
