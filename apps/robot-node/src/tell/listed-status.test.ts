import type { RobotToService } from '@farpoint/protocol';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { type CountedOperator, type ListedStatusParts, tellListedStatus } from './listed-status.ts';

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

const operator = (operatorName: string, role: string | null, connected = true): CountedOperator => ({
  operatorName,
  peer: { connected },
  messages: { access: { role } },
});

function setup(change: Partial<Pick<ListedStatusParts, 'listStatus'>> = {}) {
  const sent: Extract<RobotToService, { type: 'robot.status' }>['status'][] = [];
  const signaling = {
    takesStatus: true,
    registrations: 1,
    send: (message: RobotToService) => {
      if (message.type === 'robot.status') sent.push(message.status);
      return true;
    },
  };
  const guard = {
    leaseHolder: null as string | null,
    hasWheels: true,
    latched: false,
    estopState: () => ({ latched: guard.latched }) as ReturnType<ListedStatusParts['guard']['estopState']>,
  };
  const operators = new Map<string, CountedOperator>();
  const battery = { percentage: 0.5, voltage: 24 };
  const close = tellListedStatus({
    signaling,
    listStatus: 'state',
    version: '1.2.3',
    maxOperators: 4,
    operators,
    guard,
    board: { alarms: { raised: [] } },
    state: () => ({ battery }),
    now: () => performance.now(),
    ...change,
  });
  return { sent, signaling, guard, operators, battery, close };
}

test('tells what the robot does: STOP before a fault of the wheels, and that before a driver', () => {
  const { sent, guard } = setup();
  vi.advanceTimersByTime(250);
  expect(sent).toMatchObject([{ state: 'free', battery: 0.5, version: '1.2.3', maxOperators: 4 }]);
  guard.leaseHolder = 's1';
  vi.advanceTimersByTime(2000);
  guard.hasWheels = false;
  vi.advanceTimersByTime(2000);
  guard.latched = true;
  vi.advanceTimersByTime(2000);
  expect(sent.map(({ state }) => state)).toEqual(['free', 'driven', 'fault', 'stopped']);
});

test('counts those who are connected, and among them those who may only watch', () => {
  const { sent, operators } = setup();
  operators.set('a', operator('Ada', 'drive'));
  operators.set('b', operator('Bob', 'watch'));
  operators.set('c', operator('Cid', null));
  operators.set('d', operator('Dan', 'watch', false));
  vi.advanceTimersByTime(250);
  expect(sent).toMatchObject([{ operators: 3, watchers: 1 }]);
});

test('names the driver where it is to, and tells nothing at all where it is not to', () => {
  for (const [listStatus, told] of [
    ['names', ['Ada']],
    ['state', [undefined]],
    ['off', []],
  ] as const) {
    const { sent, guard, operators, close } = setup({ listStatus });
    operators.set('s1', operator('Ada', 'drive'));
    guard.leaseHolder = 's1';
    vi.advanceTimersByTime(10_000);
    expect(sent.map(({ driver }) => driver)).toEqual(told);
    close();
  }
});

test('leaves out a battery that is no share', () => {
  const { sent, battery } = setup();
  battery.percentage = Number.NaN;
  vi.advanceTimersByTime(250);
  battery.percentage = 42;
  vi.advanceTimersByTime(5000);
  expect(sent.map((status) => 'battery' in status)).toEqual([false]);
});

test('waits for a service that takes it, and tells each connection anew', () => {
  const { sent, signaling, close } = setup();
  signaling.takesStatus = false;
  vi.advanceTimersByTime(5000);
  expect(sent).toHaveLength(0);
  signaling.takesStatus = true;
  vi.advanceTimersByTime(250);
  signaling.registrations++;
  vi.advanceTimersByTime(5000);
  expect(sent).toHaveLength(2);
  signaling.registrations++;
  close();
  vi.advanceTimersByTime(5000);
  expect(sent).toHaveLength(2);
});
