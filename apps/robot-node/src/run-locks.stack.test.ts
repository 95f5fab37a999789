/** Two robot programs that would write the same files. */
import { once } from 'node:events';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { createLogger } from '@farpoint/service';
import { LoggingProcess } from '@farpoint/service/testing';
import { isAvailable } from '@farpoint/shared-memory';
import { afterAll, afterEach, describe, expect, it } from 'vitest';
import { lockRun } from './run-locks.ts';

const program = fileURLToPath(new URL('./main.ts', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'farpoint-locks-'));
const log = createLogger({ name: 'test', level: 'silent', format: 'json' });
afterAll(() => rmSync(folder, { recursive: true }));

describe.skipIf(!isAvailable())('two robots (needs the addon: pnpm build:native)', () => {
  const robots: LoggingProcess[] = [];
  afterEach(async () => {
    for (const { child, exited } of robots.splice(0)) {
      child.kill('SIGKILL');
      await exited;
    }
  });

  const start = (id: string, state: string, ...args: string[]) => {
    const robot = new LoggingProcess(program, [
      ...['--id', id, '--state-dir', join(folder, state), '--sim-size', '16', '--admin-port', '0'],
      ...['--signaling', 'ws://127.0.0.1:9', ...args],
    ]);
    robots.push(robot);
    return robot;
  };

  const shm = ['--sink', 'shm', '--shm-folder', folder];
  const auditLog = ['--audit-log', join(folder, 'audit.jsonl')];

  it('the second one says who has what it needs, and how to mend it', { timeout: 60_000 }, async () => {
    const first = start('a', 'one', ...shm, ...auditLog);
    await first.logged('health and metrics');
    for (const [args, detail, remedy] of [
      [['a', 'one'], `id a runs with the state folder ${join(folder, 'one')}`, '--state-dir'],
      [['a', 'two', ...auditLog], `writes the audit log ${join(folder, 'audit.jsonl')}`, '--audit-log'],
      [['b', 'one', ...shm], join(folder, 'shared_control'), '--shm-folder'],
    ] as const) {
      const [id, state, ...rest] = args;
      const second = start(id, state, ...rest);
      const said = await second.logged(/^could not start: /);
      expect(await second.exited).toBe(1);
      expect(said.msg).toContain(detail);
      expect(said.msg).toContain(`(process ${first.child.pid})`);
      expect(said.remedy).toContain(remedy);
      expect(said).not.toHaveProperty('err');
    }
    const gone = once(first.child, 'exit');
    first.child.kill('SIGKILL');
    await gone;
    await start('a', 'one', ...shm, ...auditLog).logged('health and metrics');
  });

  it('each with an id of its own share a state folder, and a lock that is given back is free', () => {
    const options = { id: 'c', stateFolder: join(folder, 'shared'), audit: undefined };
    const held = lockRun(options, log);
    lockRun({ ...options, id: 'd' }, log)[Symbol.dispose]();
    expect(() => lockRun(options, log)).toThrow('another robot with the id c');
    held[Symbol.dispose]();
    lockRun(options, log)[Symbol.dispose]();
  });

  it('a robot whose folder cannot be used goes on: it starts latched for that', () => {
    const file = join(folder, 'a-file');
    writeFileSync(file, '');
    expect(() => lockRun({ id: 'e', stateFolder: file, audit: undefined }, log)).not.toThrow();
  });
});
