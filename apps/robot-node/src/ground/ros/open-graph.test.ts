import type { RosFault, RosGraph } from '@farpoint/ros';
import { expect, test } from 'vitest';
import { tellNewFaults } from './open-graph.ts';

test('a fault is told once while it repeats itself, and again after another', () => {
  const graph: Pick<RosGraph, 'onFault'> = { onFault: null };
  const told: string[] = [];
  tellNewFaults(graph, (detail) => told.push(detail));
  for (const message of ['a', 'a', 'b', 'b', 'a']) graph.onFault?.(new Error(message) as RosFault);
  expect(told).toEqual(['a', 'b', 'a']);
});
