import type { Role } from '@farpoint/protocol';
import { expect, it, vi } from 'vitest';
import type { PeerEnd } from '../../send/transport/peer-events.ts';
import { OperatorPlaces } from './operator-places.ts';

function setUp(most = 3) {
  const places = new OperatorPlaces({ most, perSubject: 2, keepMs: 1000 });
  const operators = new Map<string, ReturnType<typeof make>>();
  let driver: string | null = null;
  const make = (id: string, subject: string, role: Role, keyId: string) => {
    const grant = { id: `g-${id}`, subject, keyId, issuedAtS: 0 };
    const access = { role, subject, name: subject, expiresAtS: 1e9, keyId, grant };
    const close = vi.fn((end: PeerEnd) => end_(id, end, 0));
    return { messages: { id, access }, peer: { close }, quiet: false };
  };
  const end_ = (id: string, end: PeerEnd, nowMs: number) => {
    const operator = operators.get(id);
    operators.delete(id);
    if (operator !== undefined) places.ended(operator, end, nowMs);
  };
  const enter = (id: string, subject: string, role: Role = 'watch', nowMs = 0, keyId = 'k1') => {
    const operator = make(id, subject, role, keyId);
    operators.set(id, operator);
    const refused = places.enter(operator, operators, driver, nowMs);
    if (refused !== null) operators.delete(id);
    return { refused, close: operator.peer.close };
  };
  const drive = (id: string | null, nowMs: number) => {
    driver = id;
    places.noteDriver(id, nowMs);
  };
  return { places, operators, enter, drive, end: end_ };
}

it('one subject cannot take all places, and another of the same name with another issuer is somebody else', () => {
  const { enter } = setUp(4);
  const asked = ['a', 'b', 'c', 'd'].map((id) => enter(id, 'wim').refused);
  expect(asked.map((each) => each === null)).toEqual([true, true, false, false]);
  expect(asked[3]).toContain('2 sessions');
  expect(enter('e', 'wim', 'watch', 0, 'k2').refused).toBeNull();
});

it('a supervisor displaces a watcher, which is told so; who drove lately is not idle', () => {
  const { enter, drive, operators } = setUp();
  enter('a', 'ada', 'drive', 0);
  enter('b', 'bob', 'watch', 100);
  const idle = enter('c', 'cyd', 'watch', 50);
  expect(enter('s', 'sue', 'supervise', 200).refused).toBeNull();
  expect(idle.close).toHaveBeenCalledExactlyOnceWith('robot-full', expect.stringContaining('higher role'));
  drive('a', 300);
  expect(enter('t', 'tom', 'supervise', 400).refused).toBeNull();
  expect([...operators.keys()]).toEqual(['a', 's', 't']);
});

it('keeps the place of who drove for a while after a loss, but not after a farewell', () => {
  const { enter, drive, end } = setUp();
  enter('a', 'ada', 'drive');
  enter('b', 'bob');
  enter('c', 'cyd');
  drive('a', 10);
  drive(null, 20);
  end('a', 'silent', 100);
  expect(enter('d', 'dan', 'watch', 1099).refused).toContain('taken');
  expect(enter('a2', 'ada', 'drive', 1099).refused).toBeNull();
  drive('a2', 1100);
  end('a2', 'silent', 1200);
  expect(enter('d', 'dan', 'watch', 2200).refused).toBeNull();
  end('d', 'closed', 2300);
  enter('a3', 'ada', 'drive', 2300);
  drive('a3', 2400);
  end('a3', 'closed', 2500);
  expect(enter('e', 'eve', 'watch', 2501).refused).toBeNull();
});

it('asks nobody for a place twice', () => {
  const { places, operators, enter } = setUp(1);
  const { close } = enter('a', 'ada');
  const again = operators.get('a');
  expect(again && places.enter(again, operators, null, 10)).toBeNull();
  expect(close).not.toHaveBeenCalled();
});
