import { decodeJson, encodeJson, type Operators, type Role, robotSessionCodec } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import { openAccess } from './access.ts';
import { OperatorRoster } from './operator-roster.ts';

function operator(id: string, role: Role = 'drive', name = id) {
  const inbox: Operators[] = [];
  const made = {
    messages: {
      id,
      heardMs: 0,
      access: {
        ...{ role, subject: id, name, expiresAtS: 1, keyId: 'k' },
        grant: { id, subject: id, keyId: 'k', issuedAtS: 0 },
      },
      // The operator's own decoder must be able to read what the robot sends.
      send: (message: Operators) =>
        inbox.push(decodeJson(robotSessionCodec, encodeJson(robotSessionCodec, message)) as Operators),
    },
    peer: { connected: true },
  };
  const taken = () =>
    inbox.splice(0).map(({ operators, more }) => ({ more, names: operators.map(({ name }) => name) }));
  return { made: made as typeof made & Parameters<OperatorRoster['numberOf']>[0], inbox, taken };
}

it('tells everyone at each change, at most four times a second, the own entry first', () => {
  const roster = new OperatorRoster();
  const [ada, wim, sue] = [operator('ada'), operator('wim', 'watch'), operator('sue', 'supervise')];
  const all = [ada.made, wim.made, sue.made];
  roster.sendDue(all, 'wim', 0);
  expect(ada.inbox).toEqual([
    {
      type: 'operators',
      operators: [
        { number: 1, name: 'ada', role: 'drive', drives: false, you: true },
        { number: 2, name: 'wim', role: 'watch', drives: true, you: false },
        { number: 3, name: 'sue', role: 'supervise', drives: false, you: false },
      ],
      drivesForS: 0,
    },
  ]);
  expect(sue.taken()).toEqual([{ names: ['sue', 'wim', 'ada'] }]);
  ada.taken();
  roster.sendDue(all, null, 249);
  roster.sendDue([ada.made, sue.made], null, 249);
  expect(ada.taken()).toEqual([]);
  roster.sendDue([ada.made, sue.made], null, 250);
  expect(ada.taken()).toEqual([{ names: ['ada', 'sue'] }]);
  roster.sendDue([ada.made, sue.made], null, 1000);
  expect(ada.taken()).toEqual([]);
});

it('says for how long the driver has driven, and who is away', () => {
  const roster = new OperatorRoster();
  const [ada, bob] = [operator('ada'), operator('bob')];
  const both = [ada.made, bob.made];
  const hear = (operator: typeof ada, heardMs: number) => Object.assign(operator.made.messages, { heardMs });
  roster.sendDue(both, 'ada', 1000);
  roster.sendDue(both, 'ada', 3000);
  expect(ada.inbox.splice(0)).toMatchObject([{ drivesForS: 0 }]);
  hear(ada, 9000);
  roster.sendDue(both, 'ada', 9000);
  expect(ada.inbox.splice(0)).toMatchObject([
    { operators: [{ drives: true }, { away: true }], drivesForS: 8 },
  ]);
  hear(bob, 9000);
  roster.sendDue(both, 'bob', 9250);
  roster.sendDue(both, null, 9500);
  const told = ada.inbox.map(({ operators, drivesForS }) => [operators[1]?.away, drivesForS]);
  expect(told).toEqual([
    [undefined, 0],
    [undefined, undefined],
  ]);
});

it('lists everybody where nobody is asked for a grant, with names that nothing proves', () => {
  const roster = new OperatorRoster();
  const ada = operator('ada');
  Object.assign(ada.made.messages, { access: openAccess('Ada') });
  roster.sendDue([ada.made], null, 0);
  expect(ada.inbox[0]?.operators).toEqual([
    { number: 1, name: 'Ada', claimed: true, role: 'drive', drives: false, you: true },
  ]);
});

it('lists as many as fit a message where names are long in bytes, and counts the rest', () => {
  const roster = new OperatorRoster();
  const all = Array.from({ length: 16 }, (_, i) => operator(`o${i}`, 'supervise', '\u4e16'.repeat(64)));
  roster.sendDue(
    all.map(({ made }) => made),
    'o15',
    0,
  );
  const [first] = all[0]?.inbox ?? [];
  expect((first?.operators.length ?? 0) + (first?.more ?? 0)).toBe(16);
  expect(first?.more).toBeGreaterThan(0);
});

it('lists nobody who is not admitted or not connected, and gives no number twice', () => {
  const roster = new OperatorRoster();
  const [ada, other] = [operator('ada'), operator('other')];
  const stranger = {
    ...operator('x').made,
    messages: {
      ...operator('x').made.messages,
      access: { ...operator('x').made.messages.access, grant: null },
    },
  };
  other.made.peer.connected = false;
  roster.sendDue([ada.made, other.made, stranger], null, 0);
  expect(ada.taken()).toEqual([{ names: ['ada'] }]);
  other.made.peer.connected = true;
  roster.sendDue([ada.made, other.made], null, 250);
  roster.sendDue([ada.made], null, 500);
  const again = operator('other');
  roster.sendDue([ada.made, again.made], null, 750);
  const numbers = ada.inbox.map(({ operators }) => operators[1]?.number);
  expect(numbers).toEqual([2, undefined, 3]);
  expect([roster.has(again.made, 3), roster.has(again.made, 2)]).toEqual([true, false]);
});

it('fits a message with the most operators and the longest names, and counts the rest', () => {
  const roster = new OperatorRoster();
  const all = Array.from({ length: 32 }, (_, i) =>
    operator(`o${i}`, 'supervise', (i % 2 ? '"' : '\ud800').repeat(64)),
  );
  roster.sendDue(
    all.map(({ made }) => made),
    'o31',
    0,
  );
  for (const { inbox } of all) {
    expect(inbox).toHaveLength(1);
    expect([inbox[0]?.operators.length, inbox[0]?.more, inbox[0]?.operators[0]?.you]).toEqual([16, 16, true]);
    expect(inbox[0]?.operators.some(({ drives }) => drives)).toBe(true);
  }
});
