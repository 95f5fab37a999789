import { decodeJson, encodeJson, type RobotSessionMessage, robotSessionCodec } from '@farpoint/protocol';
import { makeGuard } from '@farpoint/safety/testing';
import { silentLogger } from '@farpoint/service';
import { expect, it, vi } from 'vitest';
import { openAccess } from '../../admit/access/access.ts';
import { type ListedOperator, OperatorRoster } from '../../admit/access/operator-roster.ts';
import { RobotCounters } from '../../ground/robot-counters.ts';
import { People } from './people.ts';

/** Ada drives a robot that asks for grants, which Bob has too; Wim's lets him watch, and Eve has shown none. */
function robot() {
  let nowMs = 0;
  const guard = makeGuard();
  const operators = new Map<string, ListedOperator>();
  const roster = new OperatorRoster();
  const counters = new RobotCounters();
  const host = { drive: { guard, apply: vi.fn() }, leaseChanged: vi.fn(), now: () => nowMs };
  const people = new People({ operators, roster, host, counters, log: silentLogger() });
  const join = (id: string, change: Partial<ListedOperator['messages']['access']> = {}) => {
    const inbox: RobotSessionMessage[] = [];
    const grant = { id, subject: id, keyId: 'k', issuedAtS: 0 };
    const access = { role: 'drive' as const, subject: id, name: id, expiresAtS: 1, keyId: 'k', grant };
    const send = (message: RobotSessionMessage) =>
      void inbox.push(decodeJson(robotSessionCodec, encodeJson(robotSessionCodec, message)));
    const made = {
      messages: { id, access: { ...access, ...change }, heardMs: 0, send },
      peer: { connected: true },
    };
    operators.set(id, made);
    roster.numberOf(made);
    return { made, taken: () => inbox.splice(0) };
  };
  const [ada, bob, wim] = [join('ada'), join('bob'), join('wim', { role: 'watch' })];
  const eve = join('eve', { role: 'watch', grant: null });
  guard.requestLease('ada', false, 0);
  const pass = (ms: number) => {
    nowMs += ms;
    people.update();
  };
  return { people, guard, host, counters, operators, join, pass, ada, bob, wim, eve };
}

it('tells both of an offer and its end, moves the lease, and counts it', () => {
  const { people, guard, host, counters, ada, bob, wim, pass } = robot();
  people.request(ada.made, { type: 'driveOffer', to: 2 });
  const offer = {
    ...{ type: 'handover', id: 1, kind: 'offer' },
    ...{ from: { number: 1, name: 'ada' }, to: { number: 2, name: 'bob' } },
  };
  expect(ada.taken()).toEqual([{ ...offer, yours: true, leftMs: 15_000 }]);
  expect(bob.taken()).toEqual([{ ...offer, yours: false, leftMs: 15_000 }]);
  pass(2000);
  host.leaseChanged.mockImplementation(() => expect(host.drive.apply).toHaveBeenCalled());
  people.request(bob.made, { type: 'driveAnswer', id: 1, accept: true });
  expect(host.leaseChanged).toHaveBeenCalledExactlyOnceWith('handed-over');
  expect(guard.leaseHolder).toBe('bob');
  expect(guard.awaitsLetGo).toBe(true);
  expect(ada.taken()).toEqual([{ ...offer, yours: true, ended: 'accepted' }]);
  expect(bob.taken()).toEqual([{ ...offer, yours: false, ended: 'accepted' }]);
  expect([wim.taken(), [...counters.handovers.entries()]]).toEqual([[], [['offer-accepted', 1]]]);
});

it('says why something was not done, and does nothing for who is not admitted', () => {
  const { people, ada, bob, wim, eve, pass } = robot();
  const reasons = (operator: typeof ada) =>
    operator.taken().map((message) => message.type === 'fault' && message.reason);
  people.request(wim.made, { type: 'driveAsk' });
  people.request(bob.made, { type: 'driveOffer', to: 1 });
  people.request(ada.made, { type: 'driveOffer', to: 3 });
  people.request(ada.made, { type: 'driveOffer', to: 77 });
  expect([reasons(wim), reasons(bob), reasons(ada)]).toEqual([
    ['not-permitted'],
    ['not-driver'],
    ['only-watches', 'unknown-operator'],
  ]);
  for (let n = 0; n < 9; n++) people.request(bob.made, { type: 'driveAsk' });
  expect(reasons(bob)).toEqual([false, ...Array(3).fill('already-open'), ...Array(5).fill('rate-limited')]);
  people.request(eve.made, { type: 'driveAsk' });
  people.request(eve.made, { type: 'driveOffer', to: 2 });
  expect([reasons(eve), ada.taken().map(({ type }) => type)]).toEqual([[], ['handover']]);
  pass(15_000);
  expect([bob.taken(), ada.taken()].flat().map((each) => each.type === 'handover' && each.ended)).toEqual([
    'expired',
    'expired',
  ]);
});

it('ends an offer with the session of either, and by STOP, whatever comes afterwards', () => {
  const { people, guard, operators, counters, ada, bob } = robot();
  people.request(ada.made, { type: 'driveOffer', to: 2 });
  operators.delete('bob');
  people.gone('bob');
  expect(ada.taken().at(-1)).toMatchObject({ ended: 'left' });
  operators.set('bob', bob.made);
  people.request(ada.made, { type: 'driveOffer', to: 2 });
  guard.latchEstop('operator', 'wim');
  guard.releaseEstop('ada');
  people.request(bob.made, { type: 'driveAnswer', id: 2, accept: true });
  expect(guard.leaseHolder).toBe('ada');
  expect([...counters.handovers.entries()]).toEqual([
    ['offer-left', 1],
    ['offer-estop', 1],
  ]);
});

it('marks names that nothing proves', () => {
  const { people, join, ada } = robot();
  const guest = join('guest', openAccess('Ada'));
  people.request(guest.made, { type: 'driveAsk' });
  expect(ada.taken()).toMatchObject([{ from: { name: 'Ada', claimed: true } }]);
});
