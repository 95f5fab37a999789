import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { expect, it } from 'vitest';
import { commandDelays } from './command-delay.ts';

function logOf(...rows: number[][]): string {
  const path = join(testFolder(), 'commands.csv');
  const lines = rows.map((row) => row.join(','));
  writeFileSync(path, ['sequence,sentMs,receivedMs,accepted', ...lines, ''].join('\n'));
  return path;
}

it('counts what was sent in the given time, without the delay of the link', () => {
  const path = logOf([1, 90, 1111, 1], [2, 100, 1125, 1], [3, 150, 1172, 1], [4, 200, 1221, 1]);
  expect(commandDelays(path, 1000, 20, [1100, 1200])).toEqual({ accepted: [5, 2], refused: 0 });
});

it('counts what the robot refused by itself', () => {
  const path = logOf([1, 100, 1125, 1], [2, 110, 9000, 0]);
  expect(commandDelays(path, 1000, 20, [1100, 1200])).toEqual({ accepted: [5], refused: 1 });
});
