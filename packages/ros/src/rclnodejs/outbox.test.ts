import { expect, it } from 'vitest';
import { Outbox } from './outbox.ts';

it('sends few at a time, and drops the oldest waiting message', () => {
  const sent: number[] = [];
  const out = new Outbox<number>(2, (message) => sent.push(message));
  for (let message = 1; message <= 6; message++) out.add(message);
  expect(sent).toEqual([1, 2]);
  expect(out).toMatchObject({ received: 6, dropped: 2 });
  out.taken();
  expect(sent).toEqual([1, 2, 5]);
  out.taken();
  out.taken();
  expect(sent).toEqual([1, 2, 5, 6]);
  out.taken();
  out.taken();
  out.add(7);
  expect(sent.at(-1)).toBe(7);
  expect(out).toMatchObject({ received: 7, dropped: 2 });
});
