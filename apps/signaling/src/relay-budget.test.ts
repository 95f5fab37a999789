import fc from 'fast-check';
import { expect, it } from 'vitest';
import type { Peer } from './peer.ts';
import { RelayBudgets } from './relay-budget.ts';

let ids = 0;
const at = (address: string): Peer => ({
  ...{ id: ++ids, address, backlog: 0 },
  ...{ send: () => undefined, close: () => undefined },
});
const limits = { relayBytesPerSecond: 200_000, relayMessagesPerSecond: 100 };

it('many sockets of one address are one sender', () => {
  const [budgets, robot] = [new RelayBudgets(limits), at('192.0.2.200')];
  const sockets = Array.from({ length: 10 }, () => at('203.0.113.9'));
  let bytes = 0;
  for (let ms = 0; ms < 10_000; ms += 10)
    for (const socket of sockets) if (budgets.refusal(socket, robot, 60_000, ms) === null) bytes += 60_000;
  expect(bytes).toBeLessThanOrEqual(200_000 + 10 * 50_000);
  // Somebody else is heard all the same.
  expect(budgets.refusal(at('198.51.100.1'), robot, 20_000, 10_000)).toBeNull();
});

it('operators behind a proxy on this machine are told apart by their sockets', () => {
  const [budgets, robot] = [new RelayBudgets(limits), at('192.0.2.200')];
  const [flood, other] = [at('127.0.0.1'), at('127.0.0.1')];
  while (budgets.refusal(flood, robot, 50_000, 0) === null);
  expect(budgets.refusal(flood, robot, 50_000, 0)).toBe('sender');
  expect(budgets.refusal(other, robot, 20_000, 0)).toBeNull();
});

it('a robot, and an operator, gets no more than its budget, however many send and whatever they send', () => {
  const sent = fc.record({
    sender: fc.integer({ min: 0, max: 400 }),
    bytes: fc.integer({ min: 1, max: 65_000 }),
    passMs: fc.integer({ min: 0, max: 40 }),
    byRobot: fc.boolean(),
  });
  fc.assert(
    fc.property(fc.array(sent, { minLength: 50, maxLength: 400 }), (messages) => {
      const [budgets, to] = [new RelayBudgets(limits), at('192.0.2.200')];
      let [nowMs, bytes, count] = [0, 0, 0];
      for (const message of messages) {
        nowMs += message.passMs;
        const from = message.byRobot ? null : at(`10.0.${message.sender >> 8}.${message.sender & 255}`);
        if (budgets.refusal(from, to, message.bytes, nowMs) !== null) continue;
        bytes += message.bytes;
        count++;
      }
      expect(bytes).toBeLessThanOrEqual(800_000 + nowMs * 200);
      expect(count).toBeLessThanOrEqual(400 + nowMs / 10);
    }),
  );
});
