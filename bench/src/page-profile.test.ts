import { expect, test } from 'vitest';
import { mainThreadTime } from './page-profile.ts';

const node = (id: number, functionName: string) => ({ id, callFrame: { functionName } });

test('each sample’s time counts for what it was in', () => {
  const nodes = [
    ...[node(1, '(root)'), node(2, '(idle)'), node(3, '(program)'), node(4, 'readPixels')],
    ...[node(5, 'update'), node(6, '(garbage collector)')],
  ];
  const time = mainThreadTime({
    nodes,
    samples: [2, 5, 4, 5, 3, 6],
    timeDeltas: [1000, 2000, 4000, 500, 250, 125],
  });
  expect(time).toEqual({ idleMs: 1, scriptMs: 2.625, waitingMs: 4, browserMs: 0.25 });
});

test('time does not run backwards, and a profile may be empty', () => {
  expect(mainThreadTime({ nodes: [node(1, 'f')], samples: [1], timeDeltas: [-5] }).scriptMs).toBe(0);
  expect(mainThreadTime({ nodes: [] })).toEqual({ scriptMs: 0, waitingMs: 0, browserMs: 0, idleMs: 0 });
});
