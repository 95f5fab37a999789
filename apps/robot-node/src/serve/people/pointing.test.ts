import type { RobotSessionMessage } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import { type ListedOperator, OperatorRoster } from '../../admit/access/operator-roster.ts';
import { RobotCounters } from '../../ground/robot-counters.ts';
import { Pointing } from './pointing.ts';

const AT = { x: 1, y: -2, z: 0.5 };

/** Ada and Bob may drive, Wim may watch, and Eve has shown no grant. */
function robot(watchersPoint = false) {
  let nowMs = 0;
  const operators = new Map<string, ListedOperator>();
  const roster = new OperatorRoster();
  const counters = new RobotCounters();
  const pointing = new Pointing({ operators, roster, watchersPoint, counters, now: () => nowMs });
  const join = (id: string, change: Partial<ListedOperator['messages']['access']> = {}, connected = true) => {
    const inbox: RobotSessionMessage[] = [];
    const grant = { id, subject: id, keyId: 'k', issuedAtS: 0 };
    const access = { role: 'drive' as const, subject: id, name: id, expiresAtS: 1, keyId: 'k', grant };
    const messages = {
      id,
      access: { ...access, ...change },
      heardMs: 0,
      send: (message: RobotSessionMessage) => void inbox.push(message),
    };
    const made: ListedOperator = { messages, peer: { connected } };
    operators.set(id, made);
    roster.numberOf(made);
    return { made, taken: () => inbox.splice(0) };
  };
  const [ada, bob, wim] = [join('ada'), join('bob'), join('wim', { role: 'watch' })];
  const eve = join('eve', { role: 'watch', grant: null });
  const away = join('away', {}, false);
  const point = (by: typeof ada) => pointing.point(by.made, { type: 'point', at: AT });
  const pass = (ms: number) => {
    nowMs += ms;
  };
  return { pointing, point, pass, counters, ada, bob, wim, eve, away };
}

it('tells all others who are admitted and connected, under the number of the one who points', () => {
  const { point, ada, bob, wim, eve, away } = robot();
  point(bob);
  const pointed = { type: 'pointed', by: 2, at: AT };
  expect([ada, wim].map(({ taken }) => taken())).toEqual([[pointed], [pointed]]);
  expect([bob, eve, away].map(({ taken }) => taken())).toEqual([[], [], []]);
});

it('passes on nothing of who is not admitted', () => {
  const { point, ada, bob, eve, away } = robot(true);
  point(eve);
  point(away);
  expect([ada, bob, eve].map(({ taken }) => taken())).toEqual([[], [], []]);
});

it('lets who may only watch point where that is configured, and says so', () => {
  const strict = robot();
  strict.point(strict.wim);
  expect(strict.wim.taken()).toMatchObject([{ type: 'fault', reason: 'not-permitted' }]);
  expect(strict.ada.taken()).toEqual([]);
  const open = robot(true);
  open.point(open.wim);
  expect(open.ada.taken()).toMatchObject([{ type: 'pointed', by: 3 }]);
  const may = ({ pointing, wim, ada }: ReturnType<typeof robot>) =>
    [wim, ada].map(({ made }) => pointing.told(made));
  expect(may(strict)).toEqual([
    { type: 'pointing', may: false },
    { type: 'pointing', may: true },
  ]);
  expect(may(open)[0]).toEqual({ type: 'pointing', may: true });
});

it('passes on 20 spots a second at most, of all together', () => {
  const { point, pass, counters, ada, bob, wim } = robot();
  for (let i = 0; i < 15; i++) for (const each of [ada, bob]) point(each);
  expect(wim.taken()).toHaveLength(20);
  expect([...counters.messagesRefused.entries()]).toEqual([['point:rate-limited', 10]]);
  pass(1000);
  point(ada);
  expect(wim.taken()).toHaveLength(1);
});
