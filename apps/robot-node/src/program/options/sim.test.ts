import { expect, it } from 'vitest';
import { robotOf } from './testing/robot-of.ts';

const base = (...argv: string[]) => robotOf(argv).base;

const things = (text: string) => base('--sim-things', text)?.things;

it('boxes in the simulated building are placed by the robot’s start', () => {
  expect(things('0.9,0,0.09 -1,0.5,1')).toEqual([
    { ahead: 0.9, left: 0, height: 0.09 },
    { ahead: -1, left: 0.5, height: 1 },
  ]);
});

it.each(['', '0.9,0', '0.9,0,0', '0.9,0,-1', '0.9,x,1', '99,0,1', '0.9,0,1,2'])(
  'what is no place is refused: %j',
  (text) => {
    expect(() => things(text)).toThrow('must be "ahead,left,height …" in metres');
  },
);

it('a box in the robot is refused', () => {
  expect(() => things('0.3,0.1,1')).toThrow('from the robot’s start');
});

it('has a navigator’s map and plan only where they are asked for', () => {
  expect(base()?.navigation).toEqual({ map: false, planTo: null });
  expect(base('--sim-plan-to', '12.2,-6')?.navigation).toEqual({
    map: true,
    planTo: { x: 12.2, y: -6 },
  });
  for (const text of ['', '1', '1,2,3', 'x,y', '1e9,0'])
    expect(() => base('--sim-plan-to', text)).toThrow('must be "x,y" in metres');
});
