import { decodeJson, encodeJson, type RobotSessionMessage, robotSessionCodec } from '@farpoint/protocol';
import { DriveGuard, defaultDriveLimits } from '@farpoint/safety';
import { silentLogger } from '@farpoint/service';
import { expect, it, vi } from 'vitest';
import { openAccess } from '../access/access.ts';
import { type ListedOperator, OperatorRoster } from '../access/operator-roster.ts';
import { RobotCounters } from '../telemetry/robot-counters.ts';
import { People } from './people.ts';

/** Ada drives a robot that asks for grants, which Bob has too; Wim's lets him watch, and Eve has shown none. */
function robot() {
  let nowMs = 0;
  let handles = 0;
  const guard = new DriveGuard({
    limits: defaultDriveLimits,
    randomBytes: (count) => new Uint8Array(count).fill(++handles),
  });
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
    const made = { messages: { id, access: { ...access, ...change }, send }, peer: { connected: true } };
    operators.set(id, made);
    roster.numberOf(made);
    people.joined(made);
    return { made, taken: () => inbox.splice(0) };
  };
  const [ada, bob, wim] = [join('ada'), join('bob'), join('wim', { role: 'watch' })];
  const eve = join('eve', { role: 'watch', grant: null });
  guard.requestLease('ada', false, 0);
  const pass = (ms: number) => {
    nowMs += ms;
    people.tick();
  };
  return { people, guard, host, counters, operators, join, pass, ada, bob, wim, eve };
}

it('tells both of an offer and its end, moves the lease, and counts it', () => {
  const { people, guard, host, counters, ada, bob, wim, pass } = robot();
  people.take(ada.made, { type: 'driveOffer', to: 2 });
  const offer = {
    ...{ type: 'handover', id: 1, kind: 'offer' },
    ...{ from: { number: 1, name: 'ada' }, to: { number: 2, name: 'bob' } },
  };
  expect(ada.taken()).toEqual([{ ...offer, yours: true, leftMs: 15_000 }]);
  expect(bob.taken()).toEqual([{ ...offer, yours: false, leftMs: 15_000 }]);
  pass(2000);
  host.leaseChanged.mockImplementation(() => expect(host.drive.apply).toHaveBeenCalled());
  people.take(bob.made, { type: 'driveAnswer', id: 1, accept: true });
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
  people.take(wim.made, { type: 'driveAsk' });
  people.take(bob.made, { type: 'driveOffer', to: 1 });
  people.take(ada.made, { type: 'driveOffer', to: 3 });
  people.take(ada.made, { type: 'driveOffer', to: 77 });
  expect([reasons(wim), reasons(bob), reasons(ada)]).toEqual([
    ['not-permitted'],
    ['not-driver'],
    ['only-watches', 'unknown-operator'],
  ]);
  for (let n = 0; n < 9; n++) people.take(bob.made, { type: 'driveAsk' });
  expect(reasons(bob)).toEqual([false, ...Array(3).fill('already-open'), ...Array(5).fill('rate-limited')]);
  people.take(eve.made, { type: 'driveAsk' });
  people.take(eve.made, { type: 'chat', text: 'hello' });
  expect([reasons(eve), ada.taken().map(({ type }) => type)]).toEqual([[], ['handover']]);
  pass(15_000);
  expect([bob.taken(), ada.taken()].flat().map((each) => each.type === 'handover' && each.ended)).toEqual([
    'expired',
    'expired',
  ]);
});

it('ends an offer with the session of either, and by STOP, whatever comes afterwards', () => {
  const { people, guard, operators, counters, ada, bob } = robot();
  people.take(ada.made, { type: 'driveOffer', to: 2 });
  operators.delete('bob');
  people.gone('bob');
  expect(ada.taken().at(-1)).toMatchObject({ ended: 'left' });
  operators.set('bob', bob.made);
  people.take(ada.made, { type: 'driveOffer', to: 2 });
  guard.latchEstop('operator', 'wim');
  guard.releaseEstop('ada', 0);
  people.take(bob.made, { type: 'driveAnswer', id: 2, accept: true });
  expect(guard.leaseHolder).toBe('ada');
  expect([...counters.handovers.entries()]).toEqual([
    ['offer-left', 1],
    ['offer-estop', 1],
  ]);
});

it('passes lines on to everybody who is admitted, gives the last ones to who comes, and limits their rate', () => {
  const { people, join, counters, ada, wim, eve, pass } = robot();
  people.take(wim.made, { type: 'chat', text: '<b>Mind</b> the step' });
  const line = {
    type: 'chatLine',
    number: 1,
    from: { number: 3, name: 'wim' },
    text: '<b>Mind</b> the step',
  };
  expect(ada.taken()).toEqual([{ ...line, yours: false, agoS: 0 }]);
  expect(wim.taken()).toEqual([{ ...line, yours: true, agoS: 0 }]);
  expect(eve.taken()).toEqual([]);
  for (let n = 0; n < 10; n++) people.take(wim.made, { type: 'chat', text: `${n}` });
  expect(wim.taken().map(({ type }) => type)).toEqual([
    ...Array(4).fill('chatLine'),
    ...Array(6).fill('fault'),
  ]);
  expect(counters.chatLines).toBe(5);
  pass(61_000);
  expect(join('late').taken()[0]).toEqual({ ...line, yours: false, agoS: 61 });
});

it('marks names that nothing proves', () => {
  const { people, join, ada } = robot();
  const guest = join('guest', openAccess('Ada'));
  people.take(guest.made, { type: 'chat', text: 'It is me' });
  expect(ada.taken()).toMatchObject([{ from: { name: 'Ada', claimed: true } }]);
});
