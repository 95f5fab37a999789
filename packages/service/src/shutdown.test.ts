import { expect, test, vi } from 'vitest';
import { silentLogger } from './logger.ts';
import { Shutdown } from './shutdown.ts';

function make(deadlineMs?: number) {
  const exits: number[] = [];
  const shutdown = new Shutdown({
    log: silentLogger(),
    exit: (code) => void exits.push(code),
    ...(deadlineMs === undefined ? {} : { deadlineMs }),
  });
  return { exits, shutdown };
}

test('closers run one after the other, the last added first, then exit 0', async () => {
  const { exits, shutdown } = make();
  const order: string[] = [];
  shutdown.onClose('socket', () => void order.push('socket'));
  shutdown.onClose('session', async () => {
    order.push('session begins');
    await Promise.resolve();
    order.push('session ends');
  });
  expect(shutdown.signal.aborted).toBe(false);
  const first = shutdown.end('test');
  expect(shutdown.signal.aborted).toBe(true);
  expect(await Promise.all([first, shutdown.end('again', 9)])).toEqual([0, 0]);
  expect(order).toEqual(['session begins', 'session ends', 'socket']);
  expect(exits).toEqual([0]);
});

test('an end is asked for unless it has a code of failure, and the first end counts', async () => {
  const asked = make().shutdown;
  expect(asked.isAsked).toBe(true);
  await asked.end('received SIGTERM');
  void asked.end('uncaught exception', 1);
  expect(asked.isAsked).toBe(true);
  const failed = make().shutdown;
  void failed.end('uncaught exception', 1);
  expect(failed.isAsked).toBe(false);
});

test('a closer that fails does not prevent the others from running; exit 1', async () => {
  const { exits, shutdown } = make();
  const closed = vi.fn();
  shutdown.onClose('good', closed);
  shutdown.onClose('bad', () => {
    throw new Error('no');
  });
  expect(await shutdown.end('test')).toBe(1);
  expect(closed).toHaveBeenCalledOnce();
  expect(exits).toEqual([1]);
});

test('the deadline ends a closer that hangs; exit 1', async () => {
  vi.useFakeTimers();
  try {
    const { exits, shutdown } = make(5000);
    shutdown.onClose('hangs', () => new Promise(() => {}));
    const ended = shutdown.end('test');
    await vi.advanceTimersByTimeAsync(4999);
    expect(exits).toEqual([]);
    await vi.advanceTimersByTimeAsync(1);
    expect(await ended).toBe(1);
  } finally {
    vi.useRealTimers();
  }
});

test('a second signal exits at once with 128 + its number', () => {
  const { exits, shutdown } = make();
  shutdown.onClose('hangs', () => new Promise(() => {}));
  shutdown.handleSignal('SIGTERM');
  expect(exits).toEqual([]);
  shutdown.handleSignal('SIGINT');
  expect(exits).toEqual([130]);
});
