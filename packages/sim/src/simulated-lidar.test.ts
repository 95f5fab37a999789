import { rotationMatrix } from '@farpoint/protocol';
import { describe, expect, onTestFinished, test } from 'vitest';
import { SimulatedBase } from './simulated-base.ts';
import { SimulatedLidar } from './simulated-lidar.ts';
import type { WorldDescription } from './world.ts';
import { officeWorld } from './worlds/office.ts';

async function lidarIn(world: WorldDescription, noise = 0): Promise<SimulatedLidar> {
  const lidar = await SimulatedLidar.create({ world, seed: 1 }, { noise });
  onTestFinished(() => lidar.close());
  return lidar;
}

/** A square room of 8 m with the robot in its middle. */
function room(): WorldDescription {
  const wall = (x: number, y: number) => ({
    centre: { x: x * 4.5, y: y * 4.5, z: 0 },
    size: { x: x === 0 ? 20 : 1, y: y === 0 ? 20 : 1, z: 20 },
    material: 'paint',
  });
  return {
    name: 'room',
    start: { x: 0, y: 0, yaw: 0.4 },
    lampSpacing: 3,
    materials: { paint: { texture: 'checker', colour: 0xffffff, second: 0x404040, size: 0.3 } },
    boxes: [wall(1, 0), wall(-1, 0), wall(0, 1), wall(0, -1)],
    panels: [],
    ellipsoids: [],
    movers: [],
  };
}

describe('SimulatedLidar', () => {
  test('hits the walls on all sides at their true positions', async () => {
    const world = room();
    const lidar = await lidarIn(world);
    const { points, pose } = lidar.turn(new SimulatedBase(world).snapshot);
    const [r, { x: px, y: py, z: pz }] = [rotationMatrix(pose.orientation), pose.position];
    let farthest = 0;
    for (let i = 0; i < points.length; i += 4) {
      const [x, y, z] = [points[i]!, points[i + 1]!, points[i + 2]!];
      expect(Number.isFinite(x + y + z)).toBe(true);
      const wx = px + r[0]! * x + r[1]! * y + r[2]! * z;
      const wy = py + r[3]! * x + r[4]! * y + r[5]! * z;
      expect(pz + r[6]! * x + r[7]! * y + r[8]! * z).toBeGreaterThan(-2);
      // On a wall: the depth of the nearest pixel is off by up to half a pixel of a slanted wall.
      farthest = Math.max(farthest, Math.abs(Math.max(Math.abs(wx), Math.abs(wy)) - 4));
    }
    expect(farthest).toBeLessThan(0.06);
  });

  test('the same seed and world give the same revolution; the noise has the stated size', async () => {
    const world = officeWorld();
    const { snapshot } = new SimulatedBase(world);
    const turn = async (noise: number) => (await lidarIn(world, noise)).turn(snapshot).points.slice();
    const [a, b, exact] = [await turn(0.02), await turn(0.02), await turn(0)];
    expect(a).toEqual(b);
    let [sum, count] = [0, 0];
    for (let i = 0; i < exact.length; i += 4) {
      const range = Math.hypot(exact[i]!, exact[i + 1]!, exact[i + 2]!);
      if (!Number.isFinite(range)) continue;
      sum += (Math.hypot(a[i]!, a[i + 1]!, a[i + 2]!) - range) ** 2;
      count++;
    }
    expect(count).toBeGreaterThan(5000);
    expect(Math.sqrt(sum / count)).toBeCloseTo(0.02, 3);
  });
});
