import { LineSegments, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { type SeenFrom, SensorFrusta } from './sensor-frusta.ts';

/** Looks along the world's x axis. */
const LEVEL = { x: -0.5, y: 0.5, z: -0.5, w: 0.5 };

function camera(changes: Partial<SeenFrom> = {}): SeenFrom {
  const cameraPosition = { x: 2, y: 1, z: 0.9 };
  return { cameraPosition, cameraOrientation: LEVEL, hasPoints: true, imageExtent: 2, ...changes };
}

/** The ends of a sensor's lines in the robot's world, metres. */
function ends(view: SeenFrom): [number, number, number][] {
  const frusta = new SensorFrusta();
  frusta.show([view]);
  const [lines] = frusta.object.children;
  if (!(lines instanceof LineSegments)) throw new Error('no lines');
  frusta.object.updateMatrixWorld(true);
  const position = lines.geometry.getAttribute('position');
  return Array.from({ length: position.count }, (_, i) =>
    new Vector3()
      .fromBufferAttribute(position, i)
      .applyMatrix4(lines.matrixWorld)
      .toArray()
      .map((n) => Math.round(n * 1000) / 1000 + 0),
  ) as [number, number, number][];
}

test('a camera’s frustum begins at the camera and is as wide as it sees', () => {
  const all = ends(camera());
  expect(all).toHaveLength(16);
  expect(all[0]).toEqual([2, 1, 0.9]);
  // 90°, half a metre ahead: x right and y down of the picture are -y and -z of the world.
  expect(all[1]).toEqual([2.5, 1.5, 1.4]);
  const across = ends(camera({ imageExtent: 1 })).map(([, y]) => y);
  expect(Math.max(...across) - Math.min(...across)).toBeCloseTo(0.5);
});

test('a sensor that sees all around has a circle; one without a pose nothing', () => {
  const level = ends(camera({ imageExtent: 5 })).map(([, , z]) => z);
  expect(new Set(level)).toEqual(new Set([0.9]));
  expect(new Set(ends(camera({ hasPoints: false })).map(String)).size).toBe(1);
});

test('only what is shown last is there', () => {
  const frusta = new SensorFrusta();
  frusta.show([camera(), camera()]);
  expect(frusta.object.children).toHaveLength(2);
  frusta.show([]);
  expect(frusta.object.children).toHaveLength(0);
});
