import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { useFolder } from '@farpoint/service/testing/folder';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { loadSend, Notifier, notifyOrder, type Send } from './notifier.ts';

describe('what systemd expects', () => {
  it.each([
    [{}, null],
    [{ NOTIFY_SOCKET: '' }, null],
    [{ NOTIFY_SOCKET: 'relative' }, null],
    [{ NOTIFY_SOCKET: '/run/n' }, { socket: '/run/n', watchdogMs: null }],
    [
      { NOTIFY_SOCKET: '@n', WATCHDOG_USEC: '10000000' },
      { socket: '@n', watchdogMs: 10_000 },
    ],
    [
      { NOTIFY_SOCKET: '@n', WATCHDOG_USEC: '10000000', WATCHDOG_PID: '7' },
      { socket: '@n', watchdogMs: 10_000 },
    ],
    [
      { NOTIFY_SOCKET: '@n', WATCHDOG_USEC: '10000000', WATCHDOG_PID: '8' },
      { socket: '@n', watchdogMs: null },
    ],
    [
      { NOTIFY_SOCKET: '@n', WATCHDOG_USEC: 'x' },
      { socket: '@n', watchdogMs: null },
    ],
  ])('%j', (env, order) => {
    expect(notifyOrder(env, 7)).toEqual(order);
  });
});

describe('notifier', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  function telling(watchdogMs: number | null) {
    const told: string[] = [];
    const send = (_: string, message: string) => told.push(message) * 0;
    return { told, notifier: new Notifier({ socket: '@n', watchdogMs }, send) };
  }

  it('notifies twice per watchdog time while the service is alive, and no more once it stops', () => {
    const { told, notifier } = telling(1000);
    let alive = true;
    notifier.ready(
      () => alive,
      () => 'well',
    );
    expect(told).toEqual(['READY=1\nSTATUS=well']);
    vi.advanceTimersByTime(1600);
    expect(told.slice(1)).toEqual(Array(3).fill('WATCHDOG=1'));
    alive = false;
    vi.advanceTimersByTime(5000);
    expect(told).toHaveLength(4);
    alive = true;
    notifier.stopping();
    vi.advanceTimersByTime(5000);
    expect(told.slice(4)).toEqual(['STOPPING=1']);
    expect(notifier.failed).toBe(0);
  });

  it('reports a new status within a second, and never repeats it', () => {
    const { told, notifier } = telling(null);
    let status = 'not registered';
    notifier.ready(
      () => true,
      () => status,
    );
    vi.advanceTimersByTime(3000);
    status = 'registered';
    vi.advanceTimersByTime(3000);
    notifier.stopping();
    status = 'late';
    vi.advanceTimersByTime(3000);
    expect(told).toEqual(['READY=1\nSTATUS=not registered', 'STATUS=registered', 'STOPPING=1']);
  });

  it('continues if nobody accepts its messages', () => {
    const notifier = new Notifier({ socket: '@n', watchdogMs: null }, () => 111);
    notifier.starting(1000);
    notifier.stopping();
    expect(notifier.failed).toBe(2);
  });

  it('requests the time that its start may take', () => {
    const { told, notifier } = telling(null);
    notifier.starting(12_000.5);
    expect(told).toEqual(['EXTEND_TIMEOUT_USEC=12000500']);
  });
});

const send = available();
const python = spawnSync('python3', ['--version']).status === 0;

/** Binds a datagram socket, reports that, and prints each message and its sender's process. */
const LISTENER = `
import socket, struct, sys
s = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
s.setsockopt(socket.SOL_SOCKET, socket.SO_PASSCRED, 1)
path = sys.argv[1]
s.bind("\\0" + path[1:] if path.startswith("@") else path)
print("bound", flush=True)
while True:
    data, ancillary, _, _ = s.recvmsg(4096, 256)
    print(struct.unpack("3i", ancillary[0][2])[0], data.decode().replace("\\n", ";"), flush=True)
`;

describe.skipIf(send === null || !python)(
  'a real socket (needs the addon, pnpm build:native, and Python 3)',
  () => {
    const folder = useFolder();
    let listener: ChildProcess | null = null;
    afterEach(() => void listener?.kill('SIGKILL'));

    it.each([join(folder, 'notify'), `@farpoint-test-${process.pid}`])(
      '%s receives our messages, sent by our own process',
      async (path) => {
        listener = spawn('python3', ['-c', LISTENER, path], { stdio: ['ignore', 'pipe', 'inherit'] });
        const lines = createInterface({ input: listener.stdout! })[Symbol.asyncIterator]();
        expect((await lines.next()).value).toBe('bound');
        const notifier = new Notifier({ socket: path, watchdogMs: null }, send!);
        notifier.ready(
          () => true,
          () => 'well',
        );
        expect((await lines.next()).value).toBe(`${process.pid} READY=1;STATUS=well`);
        notifier.stopping();
        expect((await lines.next()).value).toBe(`${process.pid} STOPPING=1`);
        expect(notifier.failed).toBe(0);
      },
    );

    it('a missing socket, or a name that is too long, gives an errno', () => {
      expect(send?.(join(folder, 'nobody'), 'READY=1')).not.toBe(0);
      expect(send?.(`/${'x'.repeat(107)}`, 'READY=1')).not.toBe(0);
      expect(() => send?.(1 as never, '')).toThrow();
    });
  },
);

function available(): Send | null {
  try {
    return loadSend();
  } catch {
    return null;
  }
}
