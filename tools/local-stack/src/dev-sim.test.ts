import { expect, test } from 'vitest';
import { simArguments } from './dev-sim.ts';

test('the fewer cores, the less is simulated, and never with a priority of its own', () => {
  const pointsPerS = [0, 1, 2, 3, 4, 7, 8, 64].map((cores) => {
    const args = simArguments(cores);
    const of = (flag: string) => Number(args[args.indexOf(flag) + 1]);
    expect(of('--niceness')).toBe(0);
    expect(of('--sim-size') % 4).toBe(0);
    return of('--sim-size') ** 2 * of('--fps');
  });
  expect(pointsPerS).toEqual([...pointsPerS].sort((a, b) => a - b));
  expect(pointsPerS[0]).toBeLessThan(2e6);
});
