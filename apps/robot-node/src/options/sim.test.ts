import { resolveOptions } from '@farpoint/service';
import { expect, it } from 'vitest';
import { toRobotOptions } from './robot-options.ts';
import { robotProgram } from './robot-program.ts';

function things(text: string): unknown {
  const resolved = resolveOptions(robotProgram, {
    argv: ['--sim-things', text],
    env: {},
    readFile: () => null,
  });
  if (resolved.action !== 'run') throw new Error('printed');
  return toRobotOptions(resolved.values, resolved.where).base?.things;
}

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
