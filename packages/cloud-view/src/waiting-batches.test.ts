import type { Batch } from '@farpoint/operator';
import { expect, test } from 'vitest';
import { WaitingBatches } from './waiting-batches.ts';

test('hands batches on in order and returns them; the oldest give way', () => {
  const released: number[] = [];
  const made = (packets: number) => ({ packets }) as Batch;
  const waiting = new WaitingBatches({ release: ({ packets }) => released.push(packets) });
  const dropped = Array.from({ length: 42 }, (_, i) => waiting.add(made(i + 1)));
  expect(dropped.filter((packets) => packets > 0)).toEqual([1, 2]);
  expect(released).toEqual([1, 2]);
  const taken: number[] = [];
  waiting.drain(({ packets }) => taken.push(packets));
  expect(taken).toEqual(Array.from({ length: 40 }, (_, i) => i + 3));
  expect(released).toHaveLength(42);
  waiting.drain(() => expect.unreachable('empty'));
});
