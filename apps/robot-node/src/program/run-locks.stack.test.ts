/** Two robot programs that would write the same files. */
import { once } from 'node:events';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { createLogger } from '@farpoint/service';
import { LoggingProcess } from '@farpoint/service/testing';
import { useFolder } from '@farpoint/service/testing/folder';
import { isAvailable } from '@farpoint/shared-memory';
import { afterEach, describe, expect, it } from 'vitest';
import type { RobotOptions } from './robot-configuration.ts';
import { lockRun } from './run-locks.ts';

const program = fileURLToPath(new URL('../main.ts', import.meta.url));
const folder = useFolder();
const log = createLogger({ name: 'test', level: 'silent', format: 'json' });

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
    const second = start('b', 'one', ...shm);
    const said = await second.logged(/^could not start: /);
    expect(await second.exited).toBe(1);
    expect(said.msg).toContain(join(folder, 'shared_control'));
    expect(said.msg).toContain(`(process ${first.child.pid})`);
    expect(said.remedy).toContain('--shm-folder');
    expect(said).not.toHaveProperty('err');
    // As a program does it at its start.
    const claims = (state: string, path?: string) => () =>
      lockRun(
        {
          ...{ id: 'a', stateFolder: join(folder, state) },
          audit: path === undefined ? undefined : ({ path } as RobotOptions['audit']),
        },
        log,
      );
    const path = join(folder, 'audit.jsonl');
    for (const [claim, detail, remedy] of [
      [claims('one'), `id a runs with the state folder ${join(folder, 'one')}`, '--state-dir'],
      [claims('two', path), `writes the audit log ${path}`, '--audit-log'],
    ] as const) {
      const text = (part: string) => expect.stringContaining(part) as string;
      const failure = { message: text(`${detail} (process ${first.child.pid})`), remedy: text(remedy) };
      expect(claim).toThrow(expect.objectContaining(failure));
    }
    const gone = once(first.child, 'exit');
    first.child.kill('SIGKILL');
    await gone;
    claims('one', path)()[Symbol.dispose]();
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
