import { RobotWorld } from '@farpoint/cloud-view';
import fc from 'fast-check';
import { OrthographicCamera, PerspectiveCamera } from 'three';
import { expect, it } from 'vitest';
import { floorUnder, onScreen } from './floor-pick.ts';

const world = new RobotWorld();
world.updateMatrixWorld(true);
/** At the robot's place (2, 1), 1.2 m high, looking along its x axis and down. @param pitch rad */
function eyes(pitch: number): PerspectiveCamera {
  const camera = new PerspectiveCamera(75, 16 / 9, 0.05, 200);
  camera.rotation.order = 'YXZ';
  camera.position.set(-1, 1.2, -2);
  camera.rotation.set(pitch, 0, 0);
  camera.updateMatrixWorld();
  return camera;
}

it('finds the floor before the eyes', () => {
  const place = floorUnder({ camera: eyes(-Math.PI / 4), world }, 0, 0, 0);
  expect(place?.x).toBeCloseTo(3.2);
  expect(place?.y).toBeCloseTo(1);
  // The left of the screen is the robot's left.
  expect(floorUnder({ camera: eyes(-Math.PI / 4), world }, -0.5, 0, 0)?.y).toBeGreaterThan(1.2);
});

it('finds none at the horizon and above it', () => {
  expect(floorUnder({ camera: eyes(0), world }, 0, 0, 0)).toBeNull();
  expect(floorUnder({ camera: eyes(0), world }, 0, 0.5, 0)).toBeNull();
  expect(onScreen({ camera: eyes(0), world }, { x: -3, y: 1 }, 0)).toBeNull();
});

it('finds what is shown there, also from above', () => {
  const above = new OrthographicCamera(-8, 8, 4.5, -4.5, 0.1, 200);
  above.rotation.order = 'YXZ';
  above.position.set(-1, 100, -2);
  above.rotation.set(-Math.PI / 2, 0.7, 0);
  above.updateMatrixWorld();
  const screen = fc.double({ min: -0.9, max: 0.9, noNaN: true });
  for (const camera of [eyes(-0.9), above]) {
    fc.assert(
      fc.property(screen, screen, (right, up) => {
        const place = floorUnder({ camera, world }, right, up, 0.1);
        if (place === null) return;
        const shown = onScreen({ camera, world }, place, 0.1);
        expect(shown?.right).toBeCloseTo(right, 4);
        expect(shown?.up).toBeCloseTo(up, 4);
      }),
      { seed: 2, numRuns: 100 },
    );
  }
});
