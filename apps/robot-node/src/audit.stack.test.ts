/** What the running robot writes to its audit log, and what it does not write to any log. */
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { auditCommand } from '@farpoint/audit';
import type { Role } from '@farpoint/protocol';
import { expect, it, vi } from 'vitest';
import { useGrantingRobot } from './testing/use-granting-robot.ts';

const ROBOT = 'sim-1';
const TOKEN = 'a-token-of-the-robot';
let file = '';
const { robot, grant, connect, openWith } = await useGrantingRobot(ROBOT, (folder) => {
  file = join(folder, 'audit.jsonl');
  return ['--token', TOKEN, '--audit-log', file];
});

interface Entry {
  kind: string;
  robot: string;
  session?: string;
  subject?: { name: string };
  details?: Record<string, unknown>;
}
const entries = () =>
  readFileSync(file, 'utf8')
    .trimEnd()
    .split('\n')
    .map((line) => JSON.parse(line) as Entry);

const connectAs = async (role: Role, name: string) => connect(await grant(name, role));

it('a drive from start to end, in a chain that verifies', { timeout: 60_000 }, async () => {
  const ada = await connectAs('drive', 'Ada');
  await ada.client.takeLease();
  const sue = await connectAs('supervise', 'Sue');
  sue.client.sendSession({ type: 'estop', latch: true });
  await ada.client.message('estop', ({ latched }) => latched);
  const wim = await connectAs('watch', 'Wim');
  wim.client.sendSession({ type: 'estop', latch: false });
  wim.client.sendSession({ type: 'leaseRequest', take: true });
  await wim.client.until(() => wim.client.session.filter(({ type }) => type === 'fault').length === 2);
  sue.client.sendSession({ type: 'leaseRequest', take: true });
  await ada.client.message('lease', ({ holder }) => holder === 'other');
  // As often as it likes: neither log grows without bound.
  for (let i = 0; i < 200; i++) {
    const of = 1 + i / 2;
    sue.client.sendSession(
      i % 2 === 1 ? { type: 'estop', latch: true } : { type: 'estop', latch: false, of },
    );
  }
  const stranger = await openWith();
  await stranger.until(({ type }) => type === 'session.closed');
  await sue.close();
  await vi.waitFor(() => expect(entries().at(-1)).toMatchObject({ kind: 'session-ended' }), {
    timeout: 20_000,
  });

  const told = entries();
  expect(told[0]).toMatchObject({
    ...{ kind: 'started', robot: ROBOT },
    details: { configuration: { token: 'set', simSize: 64, auditLog: file } },
  });
  const story = told.map(({ kind, subject }) => `${kind} ${subject?.name ?? ''}`);
  const once = story.filter(
    (line, i) => story.indexOf(line) === i && !/^estop|^entries|^refused Sue/.test(line),
  );
  expect(once).toEqual([
    ...['started ', 'session-began Ada', 'lease-given Ada', 'session-began Sue', 'session-began Wim'],
    ...[
      'refused Wim',
      'lease-taken Sue',
      expect.stringMatching(/^refused /),
      'lease-released Sue',
      'session-ended Sue',
    ],
  ]);
  // Sue's are releases of a latch that her next press did not make: there were too many.
  const refusals = told.filter(({ kind, subject }) => kind === 'refused' && subject?.name !== 'Sue');
  expect(refusals.map(({ details }) => details)).toEqual([
    { what: 'estop-release', reason: 'not-lease-holder' },
    { what: 'lease', reason: 'not-permitted' },
    { what: 'admission', reason: 'grant-missing' },
  ]);
  expect(story.filter((line) => line === 'estop-latched Sue').length).toBeLessThanOrEqual(60);
  const { output } = robot.stack.robot(ROBOT);
  expect(output.match(/emergency stop changed/g)?.length).toBeLessThan(30);

  // No secret, in either log.
  expect(ada.session).not.toBe('');
  for (const secret of [TOKEN, ada.session, sue.session]) {
    expect(output).not.toContain(secret);
    expect(readFileSync(file, 'utf8')).not.toContain(secret);
  }

  const said: string[] = [];
  const rim = { stdout: { write: (text: string) => said.push(text) }, stderr: process.stderr };
  expect(auditCommand('farpoint-robot', ['verify', file], rim)).toBe(0);
  const text = readFileSync(file, 'utf8');
  writeFileSync(file, text.replace('"name":"Ada"', '"name":"Eve"'));
  expect(auditCommand('farpoint-robot', ['verify', file], rim)).toBe(1);
  expect(said.at(-1)).toContain('entry 1 is not what was written');
});
