import { expect, test } from 'vitest';
import { minimapTurn } from './minimap-canvas.ts';

/** Where a direction of the world points on the map: to the right and down. */
function onMap(direction: number, yaw: number, headingUp: boolean): [number, number] {
  const turn = minimapTurn(yaw, headingUp);
  const [right, down] = [Math.cos(direction), -Math.sin(direction)];
  const round = (value: number) => Number(value.toFixed(9)) + 0;
  return [
    round(right * Math.cos(turn) - down * Math.sin(turn)),
    round(right * Math.sin(turn) + down * Math.cos(turn)),
  ];
}

test('the heading is up, and what is to the left of the robot is at the left', () => {
  for (const yaw of [0, 1, -2.5, Math.PI]) {
    expect(onMap(yaw, yaw, true)).toEqual([0, -1]);
    expect(onMap(yaw + Math.PI / 2, yaw, true)).toEqual([-1, 0]);
  }
});

test('or the world’s y axis is, whatever the heading', () => {
  expect(onMap(Math.PI / 2, 0.7, false)).toEqual([0, -1]);
  expect(onMap(0, 0.7, false)).toEqual([1, 0]);
});
