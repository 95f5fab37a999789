import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { cycles } from './cycles.ts';

const graphOf = (edges: Record<string, string[]>) => new Map(Object.entries(edges));

describe('cycles', () => {
  test('finds none in an acyclic graph, however often its paths meet', () => {
    expect(cycles(graphOf({ a: ['b', 'c'], b: ['d'], c: ['d'], d: [] }))).toEqual([]);
    expect(cycles(new Map())).toEqual([]);
  });

  test('finds every group of nodes that reach each other, without nodes that only lead there', () => {
    const graph = graphOf({ start: ['a', 'x'], a: ['b'], b: ['c'], c: ['a', 'end'], x: ['y'], y: ['x'] });
    expect(cycles(graph)).toEqual([
      ['a', 'b', 'c'],
      ['x', 'y'],
    ]);
  });

  test('joins cycles that share a node', () => {
    expect(cycles(graphOf({ a: ['b', 'c'], b: ['a'], c: ['a'] }))).toEqual([['a', 'b', 'c']]);
  });

  test('counts a node that depends on itself', () => {
    expect(cycles(graphOf({ a: ['a', 'b'], b: [] }))).toEqual([['a']]);
  });

  test('follows a chain far longer than the call stack', () => {
    const length = 100_000;
    const chain = new Map(Array.from({ length }, (_, node) => [node, node + 1 < length ? [node + 1] : []]));
    expect(cycles(chain)).toEqual([]);
  });

  test('groups exactly the nodes that reach themselves and each other', () => {
    const edges = fc.array(fc.tuple(fc.nat(6), fc.nat(6)), { maxLength: 14 });
    fc.assert(
      fc.property(edges, (pairs) => {
        const graph = new Map<number, number[]>();
        for (const [from, to] of pairs) graph.set(from, [...(graph.get(from) ?? []), to]);
        const groups = cycles(graph);
        const groupOf = (node: number) => groups.findIndex((group) => group.includes(node));
        for (let a = 0; a <= 6; a++)
          for (let b = 0; b <= 6; b++) {
            const together = reaches(graph, a, b) && reaches(graph, b, a);
            expect(groupOf(a) >= 0 && groupOf(a) === groupOf(b)).toBe(together);
          }
      }),
    );
  });
});

/** Whether at least one edge leads from one node to the other. */
function reaches(graph: ReadonlyMap<number, number[]>, from: number, to: number): boolean {
  const seen = new Set<number>();
  const open = [...(graph.get(from) ?? [])];
  for (let node = open.pop(); node !== undefined; node = open.pop()) {
    if (node === to) return true;
    if (!seen.has(node)) open.push(...(graph.get(node) ?? []));
    seen.add(node);
  }
  return false;
}
