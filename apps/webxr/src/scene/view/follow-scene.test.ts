import type { SceneFigures } from '@farpoint/cloud-view';
import { expect, test } from 'vitest';
import { followScene } from './follow-scene.ts';
import { GroundGrid } from './ground-grid.ts';
import { DEFAULT_REACH, Look } from './look.ts';

const cloud = (scene: SceneFigures, ground = 0.5) => ({ colouring: { scene, ground } }) as never;

function follow(clouds: never[]): { look: Look; height: number } {
  const [look, grid] = [new Look(), new GroundGrid()];
  for (let i = 0; i < 12; i++) followScene({ look, grid }, clouds);
  return { look, height: grid.object.position.y };
}

test('the sensor that sees farthest says where the ground is and what fits', () => {
  const camera = cloud({ ground: null, extent: 4 });
  const lidar = cloud({ ground: -1.3, extent: 20 });
  const { look, height } = follow([camera, lidar]);
  expect(height).toBeCloseTo(-1.31);
  expect(look.reach).toBe(21);
});

test('where no other ground is seen, the grid is at the robot’s base, and the reach is as usual', () => {
  for (const clouds of [[cloud({ ground: null, extent: null })], [cloud({ ground: null, extent: 8 })]]) {
    const { look, height } = follow(clouds);
    expect(height).toBeCloseTo(0.49);
    expect(look.reach).toBe(DEFAULT_REACH);
  }
});
