/** The robot program under systemd: a stand-in for systemd's socket receives its messages. */

import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { testFolder } from '@farpoint/service/testing/folder';
import { loadSend } from '@farpoint/systemd';
import { afterEach, describe, expect, it } from 'vitest';

const program = fileURLToPath(new URL('./main.ts', import.meta.url));
const SOCKET = `@farpoint-run-test-${process.pid}`;

const LISTENER = `
import socket, sys
s = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
s.bind("\\0" + sys.argv[1][1:])
print("bound", flush=True)
while True:
    print(s.recv(4096).decode().replace("\\n", ";"), flush=True)
`;

describe.skipIf(!available())('under systemd (needs the addon, pnpm build:native, and Python 3)', () => {
  const children: ChildProcess[] = [];
  afterEach(() => {
    for (const child of children) child.kill('SIGKILL');
  });

  it('the robot reports that it is up, that it is alive, and that it is ending', async () => {
    const listener = spawn('python3', ['-c', LISTENER, SOCKET], { stdio: ['ignore', 'pipe', 'inherit'] });
    children.push(listener);
    const heard = createInterface({ input: listener.stdout })[Symbol.asyncIterator]();
    const next = async () => (await heard.next()).value as string;
    expect(await next()).toBe('bound');
    const robot = spawn(
      process.execPath,
      [
        program,
        ...['--sim-size', '16', '--admin-port', '0', '--signaling', 'ws://127.0.0.1:9'],
        ...['--state-dir', testFolder()],
      ],
      { env: { ...process.env, NOTIFY_SOCKET: SOCKET, WATCHDOG_USEC: '200000' }, stdio: 'ignore' },
    );
    children.push(robot);
    const ended = new Promise((resolve) => robot.once('exit', resolve));
    expect(await next()).toBe('EXTEND_TIMEOUT_USEC=60000000');
    expect(await next()).toBe('READY=1;STATUS=0 operators; not registered');
    expect(await next()).toBe('WATCHDOG=1');
    robot.kill('SIGTERM');
    let word = await next();
    while (word.startsWith('WATCHDOG')) word = await next();
    expect(word).toBe('STOPPING=1');
    expect(await ended).toBe(0);
  }, 30_000);
});

function available(): boolean {
  try {
    loadSend();
    return spawnSync('python3', ['--version']).status === 0;
  } catch {
    return false;
  }
}
