import { MotionSupervisor } from '@farpoint/safety';
import { makeGuard } from '@farpoint/safety/testing';
import { expect, onTestFinished, test } from 'vitest';
import { DriveStation } from '../../motion/drive/drive-station.ts';
import type { PeerEnd } from '../../send/transport/peer-events.ts';
import type { OperatorMessages } from './operator-messages.ts';
import { RobotSessionHost, type RobotSessionHostParts } from './robot-session-host.ts';

/** A robot that somebody has driven, with these operators. */
function driven(operators: Record<string, { sendLease: () => void; sendEstop: () => void }> = {}) {
  let left = 0;
  const guard = makeGuard({ estopRelease: 'latcher' });
  const drive = new DriveStation(
    new MotionSupervisor(guard),
    () => undefined,
    () => 0,
  );
  onTestFinished(() => drive.close());
  const host = new RobotSessionHost({
    drive,
    estop: { request: { take: () => false }, start: { latched: null }, changed: () => undefined },
    operators: () => new Map(Object.entries(operators).map(([id, messages]) => [id, { messages }])),
    budgets: { update: () => undefined },
    audit: { driver: () => undefined, estop: () => undefined },
    log: { warn: () => undefined },
    now: () => 0,
    driverLeft: () => left++,
  } as unknown as RobotSessionHostParts);
  const change = (by: string) => {
    guard.requestLease(by, true, 0, true);
    host.leaseChanged();
  };
  change('driver');
  return { host, guard, change, left: () => left };
}

test.each<[PeerEnd, number]>([
  ['closed', 1],
  ['grant-expired', 1],
  ['grant-revoked', 1],
  ['ended-by-supervisor', 1],
  ['silent', 0],
  ['connection-lost', 0],
  ['not-reading', 0],
])('a driver whose session ends by %s has left on purpose: %i', (end, count) => {
  const { host, left } = driven();
  host.operatorGone('driver', end);
  expect(left()).toBe(count);
});

test('one that gives the lease back has left, also if it was silent for so long that it had it no more', () => {
  const { host, guard, left } = driven();
  guard.releaseLease('driver');
  host.leaseChanged('expired');
  host.driverLeaves({ id: 'driver' } as OperatorMessages);
  expect(left()).toBe(1);
});

test('who has not driven last says nothing by leaving', () => {
  const { host, change, left } = driven();
  host.operatorGone('watcher', 'closed');
  host.driverLeaves({ id: 'watcher' } as OperatorMessages);
  change('next');
  host.operatorGone('driver', 'closed');
  expect(left()).toBe(0);
  host.operatorGone('next', 'closed');
  expect(left()).toBe(1);
});

test('who pressed STOP is told until it is released, and who may release it whenever that changes', () => {
  let told = 0;
  const { host, guard } = driven({ driver: { sendLease: () => undefined, sendEstop: () => told++ } });
  const ada = { id: 'ada', operatorName: 'Ada' } as OperatorMessages;
  host.operatorCame();
  expect([told, host.estopCause('ada')]).toEqual([0, null]);
  guard.identify('ada', 'ada');
  guard.latchEstop('operator', 'ada');
  host.estopChanged(ada);
  const cause = { type: 'estopCause', latch: 1, pressedBy: 'Ada', release: 'latcher' };
  expect([told, host.estopCause('ada')]).toEqual([1, { ...cause, yours: true }]);
  expect(host.estopCause('driver')).toEqual({ ...cause, yours: false });
  host.operatorGone('ada', 'closed');
  expect([told, host.estopCause('driver')]).toEqual([2, { ...cause, yours: false, release: 'driver' }]);
  guard.identify('again', 'ada');
  host.operatorCame();
  expect([told, host.estopCause('again')]).toEqual([3, { ...cause, yours: true }]);
  expect(guard.releaseEstop(null, true)).toEqual({ released: true });
  host.estopChanged();
  expect([told, host.estopCause('driver')]).toEqual([4, null]);
});
